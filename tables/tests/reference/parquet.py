"""Writes the Parquet files that the tests of the format read, with Apache Arrow for Python.

snappy.parquet, zstd.parquet, checked.parquet: a good table. spoiled.parquet: a null, a NaN, texts, and booleans in columns of their own.
"""
import pyarrow as pa
import pyarrow.parquet as pq

good = pa.table({"az_deg": pa.array([1.5, -4.0, 0.125]), "note": pa.array(["Mars", "Moon", None])})
for codec in ("snappy", "zstd"):
    pq.write_table(good, f"{codec}.parquet", compression=codec)
# The same with checksums.
pq.write_table(good, "checked.parquet", compression="snappy", write_page_checksum=True)
spoiled = {
    "null": pa.array([1.0, None]),
    "nan": pa.array([1.0, float("nan")]),
    "text": pa.array(["1", "north"]),
    "flag": pa.array([True, False]),
}
pq.write_table(pa.table(spoiled), "spoiled.parquet")

# types.parquet: a column of each type that a cell can have, the middle cell empty. claims.parquet: a dictionary that says it
# has four hundred million entries.
from datetime import date, datetime, time
from decimal import Decimal

types = {
    "flag": pa.array([True, None, False]),
    "i8": pa.array([-128, None, 127], pa.int8()),
    "i16": pa.array([-32768, None, 32767], pa.int16()),
    "i32": pa.array([-(2**31), None, 2**31 - 1], pa.int32()),
    "i64": pa.array([1763758800123456789, None, -(2**63)], pa.int64()),
    "u8": pa.array([0, None, 255], pa.uint8()),
    "u16": pa.array([0, None, 65535], pa.uint16()),
    "u32": pa.array([0, None, 2**32 - 1], pa.uint32()),
    "u64": pa.array([0, None, 2**64 - 1], pa.uint64()),
    "f32": pa.array([0.1, None, -1e30], pa.float32()),
    "f64": pa.array([0.1, None, float("inf")], pa.float64()),
    "text": pa.array(["007", None, "two\nlines"]),
    "bytes": pa.array([b"\x00\xff", None, b""], pa.binary()),
    "fixed": pa.array([b"abc", None, b"\x00\x01\x02"], pa.binary(3)),
    "day": pa.array([date(2026, 11, 21), None, date(1969, 12, 31)]),
    "milliseconds": pa.array([datetime(2026, 11, 21, 20, 0, 0, 123000), None, datetime(1969, 1, 1)], pa.timestamp("ms")),
    "microseconds": pa.array([datetime(2026, 11, 21, 20, 0, 0, 123456), None, datetime(1969, 1, 1)], pa.timestamp("us")),
    "nanoseconds": pa.array([1763758800123456789, None, -1], pa.timestamp("ns")),
    "clock": pa.array([time(23, 59, 59, 999000), None, time(0)], pa.time32("ms")),
    "fine_clock": pa.array([time(23, 59, 59, 999999), None, time(0)], pa.time64("us")),
    "decimal": pa.array([Decimal("12345.67"), None, Decimal("-0.01")], pa.decimal128(9, 2)),
    "long_decimal": pa.array([Decimal("123456789012345.67"), None, Decimal("-0.01")], pa.decimal128(30, 2)),
}
pq.write_table(pa.table(types), "types.parquet")

pq.write_table(pa.table({"note": pa.array(["Mars", "Moon"])}), "claims.parquet", compression="none", write_statistics=False)
with open("claims.parquet", "r+b") as file:
    # The header of the dictionary's page is a Thrift struct at the start: the count is the first field of the struct in field 7.
    head = bytearray(file.read())
    at = head.index(b"\x4c\x15\x04") + 2  # field 7, a struct; its field 1, an integer: 2 as a zigzag number
    claim, count = bytearray(), 400_000_000 << 1
    while count:
        claim.append(count & 0x7F | (0x80 if count > 0x7F else 0))
        count >>= 7
    file.seek(0)
    file.truncate()
    # The page is longer by what the claim is longer; the table of contents points to pages by their places, so the padding
    # before the dictionary's data would move them: the data page is read through the dictionary's offset alone.
    file.write(head[:at] + claim + head[at + 1 :])

# half.parquet: half precision. interval.parquet: months, days and milliseconds, which DuckDB writes.
import duckdb
import numpy as np

half = pa.array(np.array([0.1, 0, -6e-8], np.float16), mask=np.array([False, True, False]))
pq.write_table(pa.table({"half": half}), "half.parquet")
intervals = "(INTERVAL '2 months 3 days 1.5 seconds'), (NULL), (INTERVAL '0 seconds')"
duckdb.sql(f"COPY (SELECT * FROM (VALUES {intervals}) t(\"interval\")) TO 'interval.parquet' (FORMAT parquet)")
