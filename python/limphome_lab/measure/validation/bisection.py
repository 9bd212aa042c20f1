"""Where something that holds ceases to."""


def limit(holds, low, high, resolution):
    """Where `holds` turns from true (at low) to false (at high)."""
    while high - low > resolution:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return 0.5 * (low + high)
