/* script_session.h - a sheet's history as a script that makes the same sheet, to the bit.
 *
 *     if (script_session_write(sheet, PAPER_SHOW_WET, "marsh.lua") != SCRIPT_OK)
 *         die(script_session_error());
 *
 * What a script can say in words it says: papers, airs, brushes, dips, strokes, what is put,
 * blotted, masked and varnished. Masks lie beside it as pictures: marsh-1.png, marsh-2.png.
 * Whatever has no words of its own, or loses a bit by them, is said by p:again("..."), which
 * holds the operation's bytes. What was undone is left out. At its end the script writes the
 * picture marsh.png with 16 bits, as `show` says.
 *
 * Threads: the sheet's. */
#ifndef LUTETIA_SCRIPT_SESSION_H
#define LUTETIA_SCRIPT_SESSION_H

#include "script.h"

#include <sheet.h>

/* Writes the script, and the pictures of its masks before it. `path` ends in ".lua", and its
 * name begins with neither a dot nor a dash. Errors: FAILED, with one line in
 * script_session_error(): no history; a paper that no script can make (a seed above 2147483647,
 * a stock that is not known); a file that cannot be written: the system's reason; no memory. A
 * script that had the name is then unchanged. */
enum script_status script_session_write(struct paper_sheet *sheet, enum paper_show show,
                                        const char *path);

/* Why the last one failed, in this thread; "" if none did. Owns: the library; valid until the
 * next failure. */
const char *script_session_error(void);

#endif
