"""What machine and clock times are of, in the words of the programs: behind every table of times stands a line of it."""


def name(time):
    """Of a time report."""
    return f"{time['machine']}, {time['clock_mhz']} MHz, clock version {time['clock_version']}"


def say(names):
    """The line behind a table, of the names that its times have."""
    print(f"\nTimes of {'; '.join(dict.fromkeys(names))}.")
