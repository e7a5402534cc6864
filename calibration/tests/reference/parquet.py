"""Writes the Parquet files that the tests of the format read, with Apache Arrow for Python.

snappy.parquet, zstd.parquet: a good table. spoiled.parquet: a null, a NaN, texts, and booleans in columns of their own.
"""
import pyarrow as pa
import pyarrow.parquet as pq

good = pa.table({"az_deg": pa.array([1.5, -4.0, 0.125]), "note": pa.array(["Mars", "Moon", None])})
for codec in ("snappy", "zstd"):
    pq.write_table(good, f"{codec}.parquet", compression=codec)
spoiled = {
    "null": pa.array([1.0, None]),
    "nan": pa.array([1.0, float("nan")]),
    "text": pa.array(["1", "north"]),
    "flag": pa.array([True, False]),
}
pq.write_table(pa.table(spoiled), "spoiled.parquet")
