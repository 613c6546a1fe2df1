"""Set up the workspace: Python packages, ROS 2 where none is sourced, and the colcon build.

``make setup`` runs this file. Any Python must be able to parse it, to be told that it is too old.
"""

import sys

OLDEST, NEWEST = (3, 10), (3, 13)

if __name__ == '__main__':
    if not OLDEST <= sys.version_info[:2] <= NEWEST:
        sys.stderr.write(
            'set-up: GeoHTN runs on Python 3.10 to 3.13 and {} is {}.{}: '
            'sudo apt install python3 python3-venv python3-dev, then add PYTHON=/usr/bin/python3 '
            'to the make command.\n'.format(sys.executable, *sys.version_info)
        )
        sys.exit(2)

    from workspace.main import main

    sys.exit(main())
