/* picture_room.c - see picture_room.h.
 *
 *     page 0: a word for each slot, 0: free | slot 0 | slot 1 | ... */
#include "picture_room.h"

#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { HEAD_BYTES = 4096, SEALS = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL };

#define ROOM_BYTES                                                                             \
    ((size_t)HEAD_BYTES + (size_t)PICTURE_ROOM_SLOTS * (size_t)PICTURE_ROOM_SLOT_BYTES)

static bool mapped(struct picture_room *room, int descriptor)
{
    void *at = mmap(NULL, ROOM_BYTES, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE,
                    descriptor, 0);
    *room = (struct picture_room){.at = NULL, .descriptor = -1};
    if (at == MAP_FAILED)
        return false;
    *room = (struct picture_room){at, descriptor};
    return true;
}

bool picture_room_make(struct picture_room *room)
{
    const int low = memfd_create("pictures", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    const int descriptor = low >= 0 && low < 3 ? fcntl(low, F_DUPFD_CLOEXEC, 3) : low;
    *room = (struct picture_room){.at = NULL, .descriptor = -1};
    if (low >= 0 && low != descriptor)
        close(low);
    if (descriptor < 0)
        return false;
    if (ftruncate(descriptor, (off_t)ROOM_BYTES) == 0 &&
        fcntl(descriptor, F_ADD_SEALS, SEALS) == 0 && mapped(room, descriptor))
        return true;
    close(descriptor);
    return false;
}

char *picture_room_text(const struct picture_room *room, const char *of,
                        char text[PICTURE_ROOM_TEXT])
{
    struct stat s = {0};
    fstat(room->descriptor, &s);
    snprintf(text, PICTURE_ROOM_TEXT, "%d %ju %s", room->descriptor, (uintmax_t)s.st_ino, of);
    return text;
}

bool picture_room_find(struct picture_room *room, const char *text, const char *of)
{
    int descriptor, end = 0;
    uintmax_t number;
    struct stat s;
    *room = (struct picture_room){.at = NULL, .descriptor = -1};
    if (!text || sscanf(text, "%9d %20ju %n", &descriptor, &number, &end) != 2 || !end ||
        strcmp(text + end, of) != 0)
        return false;
    const int seals = fcntl(descriptor, F_GET_SEALS);
    return seals >= 0 && (seals & F_SEAL_SHRINK) && fstat(descriptor, &s) == 0 &&
           s.st_ino == number && (uintmax_t)s.st_size == ROOM_BYTES && mapped(room, descriptor);
}

void picture_room_end(struct picture_room *room)
{
    if (!room->at)
        return;
    munmap(room->at, ROOM_BYTES);
    close(room->descriptor);
    *room = (struct picture_room){.at = NULL, .descriptor = -1};
}

static atomic_uint *word_of(const struct picture_room *room, int slot)
{
    return (atomic_uint *)room->at + slot;
}

int picture_room_take(struct picture_room *room)
{
    for (int slot = 0; room->at && slot < PICTURE_ROOM_SLOTS; slot++) {
        unsigned free_word = 0;
        if (atomic_compare_exchange_strong(word_of(room, slot), &free_word, 1))
            return slot;
    }
    return -1;
}

uint8_t *picture_room_slot(const struct picture_room *room, int slot)
{
    return (uint8_t *)room->at + HEAD_BYTES + (size_t)slot * PICTURE_ROOM_SLOT_BYTES;
}

void picture_room_give(struct picture_room *room, int slot)
{
    atomic_store(word_of(room, slot), 0);
}
