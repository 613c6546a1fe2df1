"""How long this process has been running."""

from __future__ import annotations

import os
import time
from pathlib import Path

_IMPORTED = time.monotonic()
_START_FIELD = 19  # of those behind the name of the executable: starttime in proc(5)


def age() -> float:
    """Seconds since the process was started; where there is no ``/proc``, since this was imported."""
    try:
        fields = Path('/proc/self/stat').read_text(encoding='utf-8').rpartition(')')[2].split()
        uptime = time.clock_gettime(time.CLOCK_BOOTTIME)
        return max(0.0, uptime - int(fields[_START_FIELD]) / os.sysconf('SC_CLK_TCK'))
    except (OSError, ValueError, IndexError, AttributeError):
        return time.monotonic() - _IMPORTED
