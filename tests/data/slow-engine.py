import subprocess, sys, time
engine = subprocess.Popen([sys.argv[1], "engine", "book-ch2"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
for line in sys.stdin:
    engine.stdin.write(line)
    engine.stdin.flush()
    answer = engine.stdout.readline()
    if line.startswith("HELLO"):
        answer = "HELLO 2 slow coverage batch=1\n"
    else:
        open("asked", "a").write("x")
        time.sleep(0.01)
    sys.stdout.write(answer)
    sys.stdout.flush()
