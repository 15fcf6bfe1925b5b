"""`python -m ambulo` is the command `ambulo`."""

from ambulo._command import main

if __name__ == "__main__":
    main()
