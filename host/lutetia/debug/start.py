"""What `lutetia debug` lets gdb read: the commands of lutetia_debug, and a stop where the library complains."""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from lutetia_debug import commands, stops

commands.add()
stops.begin()
