/* fuzz_document.c - takes random bytes and random pieces of Markdown as documents, and some of
 * them as pages or as HTML. Each is read, its spans cover its texts, pages say something, and
 * HTML is whole; or it is refused. The seeds are the same in every run, or libFuzzer's with
 * -DLUTETIA_FUZZ_TARGET. */
#include <reader_document.h>
#include <reader_html.h>
#include <reader_pages.h>

#include "../must.h"
#include "html_tags.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static void block_check(const struct reader_document *d, const struct reader_block *b)
{
    int at = 0;
    must(b->text && strlen(b->text) == (size_t)b->bytes);
    must(b->items >= 0 && b->quotes >= 0 && b->first_line >= 0);
    for (int i = 0; i < b->spans_count; i++) {
        const struct reader_span *s = &b->spans[i];
        must(s->begin == at && s->end >= s->begin && s->end <= b->bytes);
        must(!(s->look & READER_NOTE) || (s->note >= 0 && s->note < d->notes_count));
        at = s->end;
    }
    must(at == b->bytes);
}

static void pages_check(const struct reader_document *d, unsigned choice)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct reader_pages *pages;
    setup.font = "DejaVuSans";
    setup.size_px = 4 + choice % 20;
    setup.width_px = 100 + choice % 700;
    setup.height_px = 100 + choice % 500;
    setup.margin_px = choice % 50;
    setup.columns = 1 + (int)(choice % 3);
    setup.notes_px = choice & 8 ? 60 : 0;
    enum reader_status status = reader_pages_make(d, &setup, &pages);
    must(status == READER_OK || status == READER_BAD_ARGUMENT);
    for (int page = 0; status == READER_OK && page < 3; page++) {
        struct font_layout layout;
        struct page_said said;
        if (page_layout_said(reader_pages_text(pages), page, &layout, &said) != FONT_OK)
            break;
        font_layout_finish(&layout);
        page_said_finish(&said);
    }
    reader_pages_destroy(pages);
}

/* As HTML: whole, whatever the document says, and refused by nobody. */
static void html_check(struct reader_document *d)
{
    char *html = NULL;
    size_t bytes = 0;
    FILE *f = open_memstream(&html, &bytes);
    must(f && reader_document_plain(d) == READER_OK);
    must(reader_html_write(d, &(struct reader_html_setup){0}, f) == READER_OK);
    must(fclose(f) == 0 && html_wrong(html) == NULL);
    free(html);
}

static void document_check(const char *text, size_t count, uint8_t choice)
{
    struct reader_document *d;
    must(reader_document_create(&d) == READER_OK);
    enum reader_status status = reader_document_add(d, text, count);
    if (status == READER_NO_LIBRARY) {
        printf("skipped: built without cmark-gfm\n");
        exit(77);
    }
    must(status == READER_OK || status == READER_TOO_LARGE);
    for (int i = 0; i < d->labels_count; i++)
        must(d->labels[i].block >= 0 && d->labels[i].block < d->blocks_count);
    if (status == READER_OK && choice % 2 == 0)
        must(reader_document_refer(d) == READER_OK && d->lost_count <= d->lost_all);
    for (int i = 0; i < d->blocks_count; i++)
        block_check(d, &d->blocks[i]);
    for (int i = 0; i < d->note_blocks_count; i++)
        block_check(d, &d->note_blocks[i]);
    for (int i = 0; i < d->notes_count; i++)
        must(d->notes[i].first_block + d->notes[i].blocks_count <= d->note_blocks_count);
    if (status == READER_OK && choice % 8 == 0)
        pages_check(d, (unsigned)choice * 131 + (unsigned)count);
    if (status == READER_OK && choice % 8 == 1)
        html_check(d);
    reader_document_destroy(d);
}

/* The same again and again, so that passages become too long to be set at once. */
static void repeated_check(const char *text, size_t count, uint8_t choice)
{
    enum { TIMES = 200 };
    char *all = malloc(TIMES * count + 1);
    must(all != NULL);
    for (size_t i = 0; i < TIMES; i++)
        memcpy(all + i * count, text, count);
    document_check(all, TIMES * count, choice);
    free(all);
}

/* The first byte chooses what is done with it. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    if (count < 1)
        return 0;
    const char *text = (const char *)bytes + 1;
    if (bytes[0] % 32 == 1)
        repeated_check(text, count - 1, 0);
    document_check(text, count - 1, bytes[0]);
    return 0;
}

#ifndef LUTETIA_FUZZ_TARGET
#include "../fuzz_pieces.h"

static const char *const pieces[] = {"word ",
                                     "# ",
                                     "\n\n",
                                     "\n",
                                     "*",
                                     "**",
                                     "`",
                                     "``",
                                     "$",
                                     "$$",
                                     "$x_1$",
                                     "[^",
                                     "]",
                                     "]: ",
                                     "[^a]",
                                     "\n\n[^a]: ",
                                     "> ",
                                     "- ",
                                     "1. ",
                                     "    ",
                                     "\t",
                                     "```\n",
                                     "```lua live\n",
                                     "|",
                                     "|---|\n",
                                     "\n| a | b |\n|---|:-:|\n",
                                     "![",
                                     "](",
                                     "b.png)",
                                     "<div>",
                                     "<div align=center>\n",
                                     "</div>\n\n",
                                     "<p align=\"right\">",
                                     "<img align=left src=a.png width=30%>",
                                     "<details><summary>",
                                     "</summary>",
                                     "</details>",
                                     "<ol><li>",
                                     "</ol>",
                                     "<table>",
                                     "<tr>",
                                     "<th>",
                                     "<td align=right>",
                                     "</table>",
                                     "<sup>",
                                     "<kbd>",
                                     "<a href=\"",
                                     "\">",
                                     "<h2>",
                                     "<blockquote>",
                                     "&#",
                                     "<!--",
                                     "&amp;",
                                     "\\",
                                     "~~",
                                     "- [x] ",
                                     "<a id=\"a\"></a>",
                                     "<a id=a>",
                                     "</a>",
                                     "[#](#a)",
                                     "<a id=\"bibliography\"></a>",
                                     "[Figure #](#word)",
                                     "![b](c.png)",
                                     "***\n",
                                     "http://a.b ",
                                     "\xc2\x91",
                                     "\xff",
                                     "\xd8\xa8",
                                     "\xe6\x97\xa5",
                                     "```math\n",
                                     "\\frac{a}{b}",
                                     "\r\n",
                                     "= ",
                                     "\xef\xbb\xbf",
                                     "\xe2\x80\xae",
                                     "\xe2\x80\x8d",
                                     "\xcc\x81",
                                     "\r",
                                     "<![CDATA[",
                                     "<?",
                                     "a@b.",
                                     "[a]: <",
                                     "[^a]:",
                                     "|\n|-\n",
                                     "\\sqrt{",
                                     "\\left(",
                                     "x^",
                                     "---\n"};

int main(int argc, char **argv)
{
    long count = argc > 1 ? strtol(argv[1], NULL, 10) : 500;
    fuzz_pieces(pieces, sizeof pieces / sizeof *pieces, count, 80);
    printf("%ld documents\n", count);
    return 0;
}
#endif
