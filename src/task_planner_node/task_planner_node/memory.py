"""How much memory this process holds."""

from __future__ import annotations

import os
import resource
from pathlib import Path

STATM = Path('/proc/self/statm')


def resident() -> int:
    """Bytes of memory in use; where the system does not tell, the most that ever was."""
    try:
        return int(STATM.read_text(encoding='ascii').split()[1]) * os.sysconf('SC_PAGE_SIZE')
    except (OSError, ValueError, IndexError):
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
