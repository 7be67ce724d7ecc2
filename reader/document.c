/* document.c - what does not need cmark-gfm: see reader_document.h. */
#include "builder.h"

#include <stdlib.h>

_Thread_local struct error_text reader_last_error;

const char *reader_error(void)
{
    return reader_last_error.text;
}

enum reader_status reader_document_create(struct reader_document **out)
{
    *out = calloc(1, sizeof **out);
    return *out ? READER_OK : reader_fail(READER_NO_MEMORY, "no memory for a document");
}

void reader_document_destroy(struct reader_document *d)
{
    if (!d)
        return;
    for (int i = 0; i < d->blocks_count; i++)
        reader_block_finish(&d->blocks[i]);
    for (int i = 0; i < d->note_blocks_count; i++)
        reader_block_finish(&d->note_blocks[i]);
    for (int i = 0; i < d->notes_count; i++) {
        free(d->notes[i].name);
        free(d->notes[i].class);
    }
    for (int i = 0; i < d->labels_count; i++)
        free(d->labels[i].name);
    for (int i = 0; i < d->note_labels_count; i++)
        free(d->note_labels[i].name);
    free(d->note_labels);
    free(d->labels);
    free(d->lost);
    free(d->plain);
    free(d->blocks);
    free(d->note_blocks);
    free(d->notes);
    free(d);
}
