"""What was recorded and learned, as files of other tools."""
