"""The command `ambulo`."""

import signal
import sys

from ambulo import _ambulo


def main() -> None:
    """Run the command with the words of the command line, and exit with its code."""
    # The command is one call of compiled code, so Ctrl-C has to end the process.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_ambulo.command(["ambulo", *sys.argv[1:]]))
