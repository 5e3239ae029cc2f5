"""python3 tests/summary.py NAME=JUNIT.XML=EXITCODE...: counts the test cases of several JUnit files.

The last line is "N passed, N failed". A file that is missing or broken, or a run that ended red without naming a failure,
counts as one failure: nothing is green by silence.
"""

import sys
import xml.etree.ElementTree as ET


def count(file):
    """Passed and failed test cases; those that were skipped or only report a number are neither."""
    passed = failed = 0
    for case in ET.parse(file).getroot().iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is None:
            passed += 1
    return passed, failed


def main(arguments):
    all_passed = all_failed = 0
    for argument in arguments:
        name, file, code = argument.rsplit("=", 2)
        try:
            passed, failed = count(file)
        except (OSError, ET.ParseError) as error:
            print(f"{name}: no result: {error}")
            passed, failed = 0, 1
        if failed == 0 and (int(code) != 0 or passed == 0):
            print(f"{name}: ended with exit code {code} after {passed} passed")
            failed = 1
        print(f"{name}: {passed} passed, {failed} failed")
        all_passed += passed
        all_failed += failed
    print(f"{all_passed} passed, {all_failed} failed")
    return 1 if all_failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
