/* npy.h - the head of NumPy's .npy files (NEP 1), made and read.
 *
 *     "\x93NUMPY", version 1, 0; the length of the text 2 (versions 2 and 3: 4), then the text: a dictionary, spaces, a newline
 *     {'descr': '<f4', 'fortran_order': False, 'shape': (5, 13), }
 */
#ifndef PARIS_NPY_H
#define PARIS_NPY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { NPY_AXES_MAX = 32, NPY_HEAD_MAX = 1 << 16, NPY_BEGIN = 12 };

struct npy {
    char kind; /* b, u, i, f, c */
    unsigned int bytes;
    bool swapped, fortran;
    int rank;
    uint64_t shape[NPY_AXES_MAX];
    size_t head; /* bytes before the values */
};

/* Writes the head of such an array, at most NPY_HEAD_MAX bytes; returns its length. swapped and
 * fortran are ignored. */
size_t npy_make(const struct npy *npy, char *out);
/* How long the head is, by a file's first NPY_BEGIN bytes. 0: it is no .npy file, or one with a
 * head that is too long. */
size_t npy_head_length(const uint8_t begin[NPY_BEGIN]);
/* Reads a whole head. NULL: well done; else what is wrong. */
const char *npy_read(const uint8_t *head, size_t length, struct npy *npy);

#endif
