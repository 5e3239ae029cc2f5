"""python3 -m night COMMAND ...: nightly and history, which ./furrow hands over to."""

import sys

from night.command import main

sys.exit(main(sys.argv[1:]))
