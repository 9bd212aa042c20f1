"""What the scripts beside this package do, one topic per file."""
