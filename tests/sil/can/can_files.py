"""DBC files, frames and logs for the checks of this folder: nothing in common with the library's own code."""
import io
import logging

SKIPPED = {"E2eCrc", "E2eCounter", "E2eDataIdNibble", "PairIndex", "ObjectSlot"}  # of the frame, not of the list


def load(path):
    """(matrix, warnings) of a DBC by python3-canmatrix, as text."""
    log = io.StringIO()
    logging.basicConfig(stream=log, level=logging.WARNING, force=True)
    import canmatrix.formats
    log.truncate(0)  # missing optional formats
    log.seek(0)
    return canmatrix.formats.loadp_flat(str(path)), log.getvalue()


def crc(data, polynomial, width, value):
    """Bit by bit over a stream of bits."""
    for byte in data:
        for shift in range(7, -1, -1):
            feedback = (value >> (width - 1) ^ byte >> shift) & 1
            value = (value << 1 & (1 << width) - 1) ^ (polynomial if feedback else 0)
    return value


def protection_problem(data, data_id, fd):
    if fd:
        wanted = crc(data[2:] + bytes([data_id & 0xFF, data_id >> 8]), 0x1021, 16, 0xFFFF)
        return None if data[0] | data[1] << 8 == wanted else "CRC-16"
    if data[1] >> 4 != data_id >> 8:
        return "data id nibble"
    return None if data[0] == crc(bytes([data_id & 0xFF, 0]) + data[1:], 0x1D, 8, 0) else "CRC-8"


def read_log(text):
    """(time in us, id, is it an FD frame, data) of a candump log's rows."""
    for row in text.splitlines():
        stamp, _, body = row.split(" ")
        name, fd, payload = body.partition("##")
        if fd:
            payload = payload[1:]
        else:
            name, _, payload = body.partition("#")
        yield int(stamp[1:-1].replace(".", "")), int(name, 16), bool(fd), bytes.fromhex(payload)
