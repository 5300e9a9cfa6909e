for line in sys.stdin:
    verb, id, *words = line.split()
    if verb == "HELLO":
        print("HELLO 2 mine coverage window=64x64 batch=1")
    else:
        if PAUSE:
            open("slow", "a").write("x")
            time.sleep(PAUSE)
        rows = range(int(words[1])) if DRAWS else ()
        print("C", id, len(rows), *(f"{y} 0 {words[0]}" for y in rows))
    sys.stdout.flush()
