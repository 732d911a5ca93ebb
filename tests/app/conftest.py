import os

# Widgets need no screen; the true 3-D view does (offscreen it paints garbage without an error).
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
