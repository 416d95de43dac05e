"""The names and signs of other packages, answered exactly and in double precision."""
