/* pdf_object.c - objects and texts of PDF: see pdf_internal.h. */
#include "pdf_internal.h"

#include <stdlib.h>
#include <string.h>

enum font_status pdf_no_memory(void)
{
    return font_fail(FONT_NO_MEMORY, "no memory for a drawing");
}

int pdf_object(struct font_document *p)
{
    if (!array_reserve(&p->offsets, &p->offsets_capacity, p->objects + 1, sizeof *p->offsets)) {
        p->failed = true;
        return 0;
    }
    p->offsets[p->objects++] = 0;
    return p->objects;
}

void pdf_object_begin(struct font_document *p, int number)
{
    if (number > 0)
        p->offsets[number - 1] = ftell(p->f);
    fprintf(p->f, "%d 0 obj\n", number);
}

void pdf_stream(struct font_document *p, int *number, const char *more, const void *bytes,
                size_t count)
{
    size_t packed = 0;
    uint8_t *out = drawn_deflated(bytes, count, &packed);
    p->failed = p->failed || !out;
    if (!*number)
        *number = pdf_object(p);
    pdf_object_begin(p, *number);
    fprintf(p->f, "<< %s /Filter /FlateDecode /Length %zu >>\nstream\n", more, packed);
    fwrite(out, 1, out ? packed : 0, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    free(out);
}

size_t pdf_say(struct font_document *p, const char *text, size_t bytes)
{
    enum { SAID_MAX = 1 << 30 };
    size_t begin = (size_t)p->said_count;
    if (!bytes)
        return begin;
    if (bytes > SAID_MAX - begin ||
        !array_reserve(&p->said, &p->said_capacity, p->said_count + (int)bytes, 1)) {
        p->failed = true;
        return begin;
    }
    memcpy(p->said + begin, text, bytes);
    p->said_count += (int)bytes;
    return begin;
}

void pdf_text_put(const char *text, size_t bytes, FILE *f)
{
    fputs("<FEFF", f);
    pdf_utf16_put(text, 0, bytes, f);
    fputs(">", f);
}
