"""Pictures of occupancy maps: how dark each pixel is, as map_server of ROS sees it."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

#: The most cells on a side of a map.
LONGEST_SIDE = 10_000
# Beyond as many pixels pillow warns, as it does not know what is expected.
Image.MAX_IMAGE_PIXELS = LONGEST_SIDE * LONGEST_SIDE
_FORMATS = ('PNG', 'PPM', 'BMP')
_ALPHA = 3
_TOO_LARGE = f'has more than the {LONGEST_SIDE} x {LONGEST_SIDE} pixels allowed'


class ImageError(Exception):
    """Why a picture cannot be used."""


@dataclass(frozen=True, slots=True)
class Picture:
    """Brightness of pixels, the top row first.

    levels: (rows, columns) sums over the channels of a pixel, from 0, black, to ``white``.
    alpha: (rows, columns) from 0, transparent, to 255; None when all is opaque.
    """

    levels: NDArray[Any]
    white: int
    alpha: NDArray[np.uint8] | None


def read_picture(content: bytes) -> Picture:
    """The picture in the bytes of a PNG, PGM or BMP file.

    Raises ImageError when it is none, damaged, or larger than 10,000 pixels on a side.
    """
    try:
        with Image.open(BytesIO(content), formats=_FORMATS) as image:
            if max(image.size) > LONGEST_SIDE:
                raise ImageError(_TOO_LARGE)
            image.load()
            return _brightness(image)
    except UnidentifiedImageError:
        raise ImageError('is not a PNG, PGM or BMP picture') from None
    except Image.DecompressionBombError:
        raise ImageError(_TOO_LARGE) from None
    except (OSError, ValueError, SyntaxError, EOFError, OverflowError, IndexError) as error:
        raise ImageError(f'is damaged: {error}') from None


def _brightness(image: Image.Image) -> Picture:
    if image.mode.startswith('I'):
        deep: NDArray[Any] = np.asarray(image)
        return Picture(deep.astype(np.uint16), 65535, None)
    if image.mode in {'1', 'L'} and 'transparency' not in image.info:
        return Picture(np.asarray(image.convert('L')), 255, None)
    is_transparent = 'A' in image.mode or 'transparency' in image.info
    channels = np.asarray(image.convert('RGBA' if is_transparent else 'RGB'))
    levels: NDArray[Any] = np.asarray(np.sum(channels[..., :_ALPHA], axis=2, dtype=np.uint16))
    alpha = np.ascontiguousarray(channels[..., _ALPHA]) if is_transparent else None
    return Picture(levels, 3 * 255, alpha)
