"""What people write in JSON: decoded strictly, and read entry by entry with the place of every fault."""
