//! Benchmarks: side by side with hand-written floors and with peers.
