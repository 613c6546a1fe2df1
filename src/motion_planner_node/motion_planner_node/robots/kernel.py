"""Compile the numerical inner loops, and keep what was compiled for the next process."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar, cast

import numba

_Function = TypeVar('_Function', bound=Callable[..., Any])
_PACKAGE = Path(__file__).resolve().parents[1]
# Divisions follow IEEE 754, as numpy's: no exception has to be compiled into them.
_OPTIONS = {'nogil': True, 'error_model': 'numpy'}


def _digest_of_sources() -> str:
    """A digest of every kernel's source, as a kernel holds the code of those that it calls."""
    digest = hashlib.sha256()
    for room in ('robots', 'world', 'paths', 'satisfaction', 'tours'):
        for path in sorted((_PACKAGE / room).glob('*.py')):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _cache_directory() -> str | None:
    """The first directory that can be written to: numba's own choice, the package's, the user's."""
    chosen = os.environ.get('NUMBA_CACHE_DIR')
    users = os.environ.get('XDG_CACHE_HOME') or '~/.cache'
    bases = [_PACKAGE / '__pycache__', Path(users, 'geohtn')]
    for base in [Path(chosen), *bases] if chosen else bases:
        try:
            directory = base.expanduser() / f'kernels-{_digest_of_sources()}'
            directory.mkdir(parents=True, exist_ok=True)
        except (OSError, RuntimeError):
            continue
        if os.access(directory, os.W_OK):
            return str(directory)
    return None


_CACHE_DIRECTORY = _cache_directory()


@contextmanager
def _cached_in(directory: str | None) -> Iterator[None]:
    previous = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = directory or previous
    try:
        yield
    finally:
        numba.config.CACHE_DIR = previous


def kernel(function: _Function) -> _Function:
    """Compile ``function`` with numba, without the interpreter's lock and with a cache on disk.

    Where no cache can be kept the function is compiled anew in each process.
    """
    return _compiled(function, _OPTIONS)


def part(function: _Function) -> _Function:
    """A ``kernel`` that is copied into those that call it: for what inner loops consist of.

    So no references to arrays have to be counted on the way in and out.
    """
    return _compiled(function, {**_OPTIONS, '_nrt': False})


def _compiled(function: _Function, options: Mapping[str, Any]) -> _Function:
    with _cached_in(_CACHE_DIRECTORY):
        try:
            compiled = numba.njit(cache=_CACHE_DIRECTORY is not None, **options)(function)
        except RuntimeError:
            compiled = numba.njit(**options)(function)
    return cast(_Function, compiled)
