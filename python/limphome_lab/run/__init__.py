"""Training, evaluating and launching: the two processes from start to clean end, and what they leave."""
