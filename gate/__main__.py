"""python3 -m gate COMMAND ...: gate, bless and noise, which ./furrow hands over to."""

import sys

from gate.command import main

sys.exit(main(sys.argv[1:]))
