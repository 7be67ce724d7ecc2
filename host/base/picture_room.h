/* picture_room.h - memory that a program shares with who shows its pictures. A picture lies
 * there, and a few bytes in the pipe between the two say so.
 *
 *     struct picture_room room;                       // one of the two
 *     char text[PICTURE_ROOM_TEXT];
 *     if (picture_room_make(&room))
 *         setenv("..._ROOM", picture_room_text(&room, "/dev/fd/5", text), 1);
 *     ...                                             // the other
 *     picture_room_find(&room, getenv("..._ROOM"), "/dev/fd/5");
 *
 * It has slots. The program takes a free one, fills it and names it in the pipe; the other one
 * gives it back. No one waits: where no slot is free the picture goes through the pipe.
 *
 * The memory is a file without a name that cannot become shorter, so reading it is safe
 * whatever the other side does. The text holds the descriptor, the file's number and the pipe
 * that the room belongs to; a process that got the text and not the descriptor, or whose
 * pictures go elsewhere, finds nothing.
 *
 * Threads: one for each function but take and give, which any thread and process may call. */
#ifndef LUTETIA_PICTURE_ROOM_H
#define LUTETIA_PICTURE_ROOM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PICTURE_ROOM_SLOTS = 8,
    PICTURE_ROOM_SLOT_BYTES = 16 << 20, /* memory is taken for what was written only */
    PICTURE_ROOM_TEXT = 128
};

/* All zeros: there is none. */
struct picture_room {
    void *at;
    int descriptor;
};

/* False: the system refuses. The descriptor is 3 or more, and closed by exec. */
bool picture_room_make(struct picture_room *room);
/* Writes to `text`, and returns it. of: the pipe, as the other side knows it. */
char *picture_room_text(const struct picture_room *room, const char *of,
                        char text[PICTURE_ROOM_TEXT]);
/* text: NULL is fine. False: it names no room of this pipe that this process has. */
bool picture_room_find(struct picture_room *room, const char *text, const char *of);
/* A room of zeros is fine. */
void picture_room_end(struct picture_room *room);

/* A slot that was free; -1: none is. */
int picture_room_take(struct picture_room *room);
uint8_t *picture_room_slot(const struct picture_room *room, int slot);
void picture_room_give(struct picture_room *room, int slot);

#endif
