/* pdf_unpack.h - PDF as a text, to look for words in it. */
#ifndef LUTETIA_TEST_PDF_UNPACK_H
#define LUTETIA_TEST_PDF_UNPACK_H

#include "support.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* A PDF with its packed streams unpacked behind it, to look for words. Owns: the caller frees
 * it. */
static inline char *pdf_unpacked(const char *pdf, size_t bytes)
{
    char *out = NULL;
    size_t out_bytes;
    FILE *f = open_memstream(&out, &out_bytes);
    assert_non_null(f);
    for (size_t i = 0; i < bytes; i++) /* bytes of 0 would end the text */
        fputc(pdf[i] ? pdf[i] : ' ', f);
    for (const char *at = pdf;
         (at = memmem(at, bytes - (size_t)(at - pdf), "/FlateDecode /Length ", 21));) {
        uLongf room = 1 << 20;
        char *to = malloc(room);
        uLong packed = (uLong)atol(at + 21);
        at = strstr(at, "stream\n") + 7;
        assert_non_null(to);
        assert_int_equal(uncompress((Bytef *)to, &room, (const Bytef *)at, packed), Z_OK);
        for (uLongf i = 0; i < room; i++)
            fputc(to[i] ? to[i] : ' ', f);
        at += packed;
        free(to);
    }
    fclose(f);
    return out;
}

#endif
