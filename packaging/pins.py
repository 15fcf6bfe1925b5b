"""Compare the commits of the actions in the workflows with their tags: `python packaging/pins.py`.

Each line `uses: OWNER/NAME@COMMIT # vTAG` must name the commit to which the tag leads today. Needs git and a
connection to GitHub. Exit code 1 if one does not.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

WORKFLOWS = Path(__file__).resolve().parent.parent / ".github/workflows"
PIN = re.compile(r"uses: ([\w.-]+/[\w.-]+)[\w./-]*@([0-9a-f]{40}) # (v[\w.]+)")


def commits(action: str, tag: str) -> list[str]:
    """Commits of a tag; that of an annotated tag is the one whose name ends with `^{}`."""
    words = ["git", "ls-remote", f"https://github.com/{action}", f"refs/tags/{tag}", f"refs/tags/{tag}^{{}}"]
    lines = subprocess.run(words, check=True, capture_output=True, text=True).stdout.splitlines()
    return [line.split()[0] for line in lines]


def main() -> int:
    pins = {found.groups() for path in WORKFLOWS.glob("*.yml") for found in PIN.finditer(path.read_text("utf-8"))}
    wrong = 0
    for action, commit, tag in sorted(pins):
        agrees = commit in commits(action, tag)
        wrong += not agrees
        print(f"{'agrees' if agrees else 'WRONG '}  {action} {tag} {commit}")
    return 1 if wrong or not pins else 0


if __name__ == "__main__":
    sys.exit(main())
