/* h5_file.h - what reads HDF5 files: bytes, objects' headers, groups. Inside h5*.c only. */
#ifndef PARIS_H5_FILE_H
#define PARIS_H5_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define H5_REPACK "; `h5repack -l CONTI -f NONE OLD NEW` makes a file that is plain"
extern const char h5_damaged[]; /* the line for what cannot be so */

enum {
    H5_MESSAGE_SPACE = 1,
    H5_MESSAGE_LINKS = 2, /* where a new group's links are */
    H5_MESSAGE_TYPE = 3,
    H5_MESSAGE_LINK = 6,
    H5_MESSAGE_FILES = 7,
    H5_MESSAGE_LAYOUT = 8,
    H5_MESSAGE_MORE = 16,
    H5_MESSAGE_GROUP = 17 /* where an old group's names are */
};

/* ---- h5_header.c ---- */

/* A number of `bytes` (at most 8) bytes, the least one first. */
uint64_t h5_number(const uint8_t *at, int bytes);
bool h5_bytes_at(FILE *in, uint64_t at, void *bytes, size_t count);
/* As many of them as the file has. */
size_t h5_bytes_upto(FILE *in, uint64_t at, void *bytes, size_t count);

/* Passes each message of an object's header, of version 1 or 2; of a long one the first
 * kilobyte. take() returns NULL, or what is wrong, which ends it and is returned. */
enum { H5_MESSAGE_BYTES = 1024 };
typedef const char *(*h5_message_take)(void *context, unsigned type, const uint8_t *data,
                                       size_t bytes);
const char *h5_header_read(FILE *in, uint64_t at, h5_message_take take, void *context);

/* ---- h5_group.c, h5_links.c ---- */

/* What is looked for in a group. */
struct h5_search {
    FILE *in;
    const char *name;            /* "": the only one */
    uint64_t names, names_bytes; /* an old group's heap: its segment */
    uint64_t header;             /* of what was found */
    int found, left;             /* nodes and names that may still be read */
};
/* NULL: s->header is the header of what has the name. */
const char *h5_group_search(struct h5_search *s, uint64_t header);

/* One link, as a message or in a heap of links. */
const char *h5_link_take(struct h5_search *s, const uint8_t *data, size_t bytes);
/* All links of a group that has too many for its header: the heap with them, and the tree that
 * lists them. */
const char *h5_links_read(struct h5_search *s, uint64_t heap, uint64_t tree);

#endif
