import sys

for line in sys.stdin:
    verb, *words = line.split()
    if verb == "HELLO":
        print("HELLO 2 unclipped clip" if words == ["2"] else "E - say HELLO 2")
    else:
        print("G", words[0], 3, *words[1:])
    sys.stdout.flush()
