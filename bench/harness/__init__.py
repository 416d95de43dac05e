"""Speed of trueness beside other programs, on stated data. Entry point: ../run.py."""
