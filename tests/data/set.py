"""Prints a JSON file with other values at some places: set.py FILE PLACE=VALUE ..., each place a JSON pointer; `PLACE-` is removed."""
import json
import sys

file, *changes = sys.argv[1:]
document = json.load(open(file))
for change in changes:
    place, is_set, value = change.partition("=")
    *path, last = [part.replace("~1", "/") for part in place.rstrip("-").split("/")[1:]]
    at = document
    for part in path:
        at = at[int(part) if isinstance(at, list) else part]
    last = int(last) if isinstance(at, list) else last
    if is_set:
        at[last] = json.loads(value)
    else:
        del at[last]
print(json.dumps(document))
