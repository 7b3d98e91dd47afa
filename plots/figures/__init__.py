"""The figures, one a file. Each has draw(run), which yields what it drew or raises Skipped."""
