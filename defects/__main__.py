"""python3 -m defects defects ...: which ./furrow hands over to."""

import sys

from defects.command import main

sys.exit(main(sys.argv[1:]))
