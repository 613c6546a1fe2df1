"""What can be wrong with a recording."""


class RecordingError(Exception):
    """A recording that cannot be read; the message is a sentence that names the file."""
