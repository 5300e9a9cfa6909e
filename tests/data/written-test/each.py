"""Runs every function `test_...` of a file, as pytest does."""
import runpy, sys
failed = 0
for name, test in runpy.run_path(sys.argv[1]).items():
    if name.startswith('test_'):
        try:
            test()
        except Exception as error:
            failed += 1
            print(name, error)
sys.exit(failed > 0)
