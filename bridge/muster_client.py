"""Drives robots of a muster run from outside: a client of the plugin bridge.socket. Needs nothing but Python 3.8.

    import muster_client

    for tick in muster_client.connect(port=47474):
        here = tick["robot/rover/odometry"]            # one row, by the names of its columns
        for message in tick["inbox/rover/message"]:    # rows; payload is bytes, from the name of a radio
            print(message.rssi, message.payload)
        tick.set("robot/rover/command", v=0.3, w=0.1)
        tick.send("outbox/rover/message", payload=b"here", to=None)

The loop ends when the run does. docs/reference/bridge_format.md defines the format.
"""

import collections
import math
import socket
import struct
import time

MAGIC = b"MUSTERB1"
JOIN, TABLES, ROWS, STATE, COMMANDS, BYE, FAULT = range(1, 8)
NULLABLE, INFINITE, BYTES = 1, 2, 4


class BridgeError(Exception):
    """What went wrong between the client and the run."""


class _Reader:
    def __init__(self, body):
        self.body, self.at = body, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.body, self.at)
        self.at += struct.calcsize("<" + form)
        return values

    def one(self, form):
        return self.take(form)[0]

    def bytes(self):
        size = self.one("I")
        self.at += size
        return bytes(self.body[self.at - size : self.at])

    def text(self):
        return self.bytes().decode()


def _bytes(data):
    return struct.pack("<I", len(data)) + data


Column = collections.namedtuple("Column", "name unit reference nullable infinite bytes")


class Table:
    """A declared table: its name, its columns, and a type for its rows."""

    def __init__(self, reader):
        self.is_command, self.is_queue = bool(reader.one("B")), bool(reader.one("B"))
        self.name, self.set = reader.text(), reader.text()
        self.columns = []
        for _ in range(reader.one("I")):
            name, unit, reference = reader.text(), reader.text(), reader.text()
            flags = reader.one("B")
            self.columns.append(Column(name, unit, reference, bool(flags & NULLABLE), bool(flags & INFINITE), bool(flags & BYTES)))
        self.Row = collections.namedtuple("Row", [column.name for column in self.columns], rename=True)
        self.is_one_row = not self.is_queue and not self.set

    def read(self, reader, names):
        width, count = len(self.columns), reader.one("I")
        numbers = reader.take("%dd" % (count * width))
        rows = [list(numbers[r * width : (r + 1) * width]) for r in range(count)]
        for row in rows:
            for c, column in enumerate(self.columns):
                if column.bytes:
                    row[c] = reader.bytes()
                elif column.nullable and math.isnan(row[c]):
                    row[c] = None
                elif column.reference:
                    row[c] = names[column.reference][int(row[c])]
        rows = [self.Row(*row) for row in rows]
        return rows[0] if self.is_one_row else rows

    def cells(self, values, named, names):
        """One row as numbers and bytes, from values in order or by name."""
        if values and named:
            raise BridgeError(f"{self.name}: values in order or by name, not both")
        if named or (self.is_queue and not values):
            unknown = set(named) - {column.name for column in self.columns}
            if unknown:
                raise BridgeError(f"{self.name} has no column {sorted(unknown)[0]}; expected one of {', '.join(column.name for column in self.columns)}")
            values = []
            for c, column in enumerate(self.columns):
                is_owner = self.is_queue and c == 0 and not self.name.split("/")[1] == "*"
                if column.name not in named and not (column.nullable or column.bytes or is_owner):
                    raise BridgeError(f"{self.name} lacks the column {column.name}")
                values.append(named.get(column.name, b"" if column.bytes else 0.0 if is_owner else None))
        if len(values) != len(self.columns):
            raise BridgeError(f"{self.name}: {len(values)} values; expected {len(self.columns)}")
        numbers, blobs = [], b""
        for column, value in zip(self.columns, values):
            if column.bytes:
                blobs += _bytes(bytes(value))
                value = len(value)
            elif isinstance(value, str) and column.reference:
                if value not in names[column.reference]:
                    raise BridgeError(f"{self.name}: no {column.reference} is called {value}; expected one of {', '.join(names[column.reference])}")
                value = names[column.reference].index(value)
            numbers.append(math.nan if value is None else float(value))
        return numbers, blobs


class Tick:
    """What the client sees of a tick, and what it commands in it."""

    def __init__(self, client, index, time_now, values):
        self._client, self.index, self.time, self._values = client, index, time_now, values
        self.dt = client.dt
        self._given = {}

    def __getitem__(self, table):
        """One row, or a list of rows."""
        return self._values[self._client.find(table, False).name]

    def names(self, set_name):
        """Names of the rows of a set that a declared table is of or refers to: 'robot', 'radio'."""
        return self._client.names[set_name]

    def set(self, table, *values, **named):
        """Commands one row: set("robot/rover/command", 0.3, 0.1), or v=0.3, w=0.1."""
        port = self._client.find(table, True)
        if port.is_queue or not port.is_one_row:
            raise BridgeError(f"{table} has many rows; expected " + ("send()" if port.is_queue else "set_all()"))
        self._given[port.name] = [port.cells(values, named, self._client.names)]

    def set_all(self, table, rows):
        """Commands every row of a table, in the order of names()."""
        port = self._client.find(table, True)
        self._given[port.name] = [port.cells(tuple(row), {}, self._client.names) for row in rows]

    def send(self, table, *values, **named):
        """Appends a message to a queue: send("outbox/rover/message", payload=b"here")."""
        port = self._client.find(table, True)
        if not port.is_queue:
            raise BridgeError(f"{table} is no queue; expected set()")
        self._given.setdefault(port.name, []).append(port.cells(values, named, self._client.names))

    def _frame(self):
        body = struct.pack("<BQ", COMMANDS, self.index)
        for port in self._client.tables:
            if not port.is_command:
                continue
            rows = self._given.get(port.name)
            if rows is None and not port.is_queue:
                raise BridgeError(f"nothing was given for {port.name} at tick {self.index}; expected set()")
            rows = rows or []
            body += struct.pack("<I", len(rows))
            body += b"".join(struct.pack("<%dd" % len(numbers), *numbers) for numbers, _ in rows)
            body += b"".join(blobs for _, blobs in rows)
        return body


class Client:
    """A connection to a run; iterating it gives one Tick after the other. Commands go out when the next is asked for."""

    def __init__(self, connection):
        self._connection = connection
        self.names, self.tables, self.dt = {}, [], 0.0
        self.end = None  # why the run ended, once it has
        self._send(bytes([JOIN]) + MAGIC)
        kind, reader = self._receive()
        if kind != TABLES:
            raise BridgeError("what is there is no bridge of muster")
        self.dt = reader.one("d")
        for _ in range(reader.one("I")):
            name = reader.text()
            self.names[name] = [reader.text() for _ in range(reader.one("I"))]
        self.tables = [Table(reader) for _ in range(reader.one("I"))]

    def find(self, name, is_command):
        for table in self.tables:
            if table.name == name and table.is_command == is_command:
                return table
        known = ", ".join(table.name for table in self.tables if table.is_command == is_command)
        raise BridgeError(f"the bridge {'writes' if is_command else 'reads'} no table {name}; expected one of {known or 'none'}")

    def __iter__(self):
        while True:
            tick = self._next()
            if tick is None:
                return
            yield tick
            try:
                self._send(tick._frame())
            except OSError:  # the run has ended meanwhile; its last words may still be there
                pass

    def close(self):
        """Leaves the run; what it does then is its on_silence."""
        try:
            self._send(bytes([BYE]) + _bytes(b"the client leaves"))
        except OSError:
            pass
        self._connection.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _next(self):
        while True:
            kind, reader = self._receive()
            if kind == STATE:
                index, now = reader.take("Qd")
                values = {table.name: table.read(reader, self.names) for table in self.tables if not table.is_command}
                return Tick(self, index, now, values)
            if kind == ROWS:
                name = reader.text()
                first = reader.one("I")
                self.names[name][first:] = [reader.text() for _ in range(reader.one("I"))]
            elif kind == BYE:
                self.end = reader.text()
                return None
            elif kind == FAULT:
                raise BridgeError(reader.text())
            else:
                raise BridgeError(f"a frame of kind {kind}, which this client does not know")

    def _send(self, body):
        self._connection.sendall(struct.pack("<I", len(body)) + body)

    def _receive(self):
        body = self._exactly(struct.unpack("<I", self._exactly(4))[0])
        return body[0], _Reader(memoryview(body)[1:])

    def _exactly(self, count):
        parts = []
        while count:
            part = self._connection.recv(min(count, 1 << 20))
            if not part:
                raise BridgeError("the run has gone")
            parts.append(part)
            count -= len(part)
        return b"".join(parts)


def connect(port=47474, path=None, wait=30.0):
    """A Client of the run that listens at 127.0.0.1:port, or at the Unix socket `path`; tries for `wait` seconds."""
    until = time.monotonic() + wait
    while True:
        connection = socket.socket(socket.AF_UNIX if path else socket.AF_INET, socket.SOCK_STREAM)
        try:
            connection.connect(path or ("127.0.0.1", port))
            break
        except OSError as why:
            connection.close()
            if time.monotonic() >= until:
                raise BridgeError(f"no run listens at {path or f'127.0.0.1:{port}'}: {why.strerror}") from None
            time.sleep(0.05)
    if not path:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return Client(connection)
