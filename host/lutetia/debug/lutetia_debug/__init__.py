"""The commands that `lutetia debug` adds to gdb.

values.py and pictures.py know nothing of gdb: what the bytes of an answer are, and how they are shown. program.py asks the program
(paris_compat/debug.h). commands.py has the commands, and stops.py what happens where the program stops.
"""
