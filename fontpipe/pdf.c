/* pdf.c - a document's objects, one after the other, and the table at the end that says where
 * each begins: see document.h, pdf_internal.h. */
#include "colour.h"
#include "pdf_internal.h"

#include <stdlib.h>
#include <string.h>

enum font_status font_document_create(const struct font_document_def *def,
                                      struct font_document **out)
{
    struct font_document *p = calloc(1, sizeof *p);
    *out = NULL;
    if (!p)
        return pdf_no_memory();
    p->title = def->title ? strdup(def->title) : NULL;
    p->language = def->language ? strdup(def->language) : NULL;
    p->f = open_memstream(&p->whole, &p->whole_bytes);
    p->failed = !p->f || (def->title && !p->title) || (def->language && !p->language);
    if (!p->failed) {
        fputs("%PDF-1.7\n%\xe2\xe3\xcf\xd3\n", p->f);
        p->list_number = pdf_object(p);
        p->fonts_number = pdf_object(p);
    }
    if (p->failed) {
        font_document_destroy(p);
        return pdf_no_memory();
    }
    *out = p;
    return FONT_OK;
}

void font_document_destroy(struct font_document *p)
{
    if (!p)
        return;
    for (int i = 0; i < p->fonts_count; i++)
        free(p->fonts[i].letters);
    if (p->f)
        fclose(p->f);
    free(p->whole);
    free(p->title);
    free(p->language);
    free(p->letters);
    free(p->fonts);
    free(p->said);
    free(p->pages);
    free(p->elements);
    free(p->marks);
    free(p->offsets);
    free(p);
}

enum font_status font_document_page(struct font_document *p, const struct font_drawing *d,
                                    const struct font_layout *layout,
                                    const struct font_map *map, double x, double y)
{
    struct font_layout spread;
    if (p->written)
        return font_fail(FONT_BAD_ARGUMENT, "the document is written already");
    enum font_status status = drawn_inks_check(layout);
    if (status == FONT_OK)
        status = font_colour_spread(layout, &spread);
    if (status == FONT_OK) {
        status = pdf_page_put(p, d, &spread, map, x, y);
        font_layout_finish(&spread);
    }
    if (status == FONT_OK && p->failed)
        status = pdf_no_memory();
    p->failed = p->failed || status != FONT_OK;
    return status;
}

/* The list of pages, and the document itself. Its number. */
static int catalog_put(struct font_document *p, struct pdf_catalog *c)
{
    pdf_object_begin(p, p->list_number);
    fputs("<< /Type /Pages /Kids [", p->f);
    for (int i = 0; i < p->pages_count; i++)
        fprintf(p->f, "%s%d 0 R", i ? " " : "", p->pages[i].number);
    fprintf(p->f, "] /Count %d >>\nendobj\n", p->pages_count);
    pdf_tags_put(p, c);
    int number = pdf_object(p);
    pdf_object_begin(p, number);
    fprintf(p->f, "<< /Type /Catalog /Pages %d 0 R", p->list_number);
    if (p->language) {
        fputs(" /Lang ", p->f);
        pdf_text_put(p->language, strlen(p->language), p->f);
    }
    if (p->title)
        fputs(" /ViewerPreferences << /DisplayDocTitle true >>", p->f);
    if (c->tags)
        fprintf(p->f, " /MarkInfo << /Marked true >> /StructTreeRoot %d 0 R", c->tags);
    if (c->outline)
        fprintf(p->f, " /Outlines %d 0 R", c->outline);
    if (c->metadata)
        fprintf(p->f, " /Metadata %d 0 R", c->metadata);
    fputs(" >>\nendobj\n", p->f);
    return number;
}

enum font_status font_document_write(struct font_document *p, FILE *file)
{
    struct pdf_catalog catalog = {0};
    if (p->failed || p->written || !p->pages_count)
        return font_fail(FONT_BAD_ARGUMENT, "%s",
                         p->failed    ? "a page of the document could not be made"
                         : p->written ? "the document is written already"
                                      : "the document has no page");
    p->written = true;
    enum font_status status = pdf_fonts_put(p);
    int number = catalog_put(p, &catalog);
    long table = ftell(p->f);
    fprintf(p->f, "xref\n0 %d\n0000000000 65535 f \n", p->objects + 1);
    for (int i = 0; i < p->objects; i++)
        fprintf(p->f, "%010ld 00000 n \n", p->offsets[i]);
    fprintf(p->f,
            "trailer\n<< /Size %d /Root %d 0 R /Info %d 0 R >>\nstartxref\n%ld\n%%%%EOF\n",
            p->objects + 1, number, catalog.info, table);
    bool whole = fclose(p->f) == 0;
    p->f = NULL;
    if (status == FONT_OK && (!whole || p->failed))
        status = pdf_no_memory();
    if (status == FONT_OK && fwrite(p->whole, 1, p->whole_bytes, file) != p->whole_bytes)
        status = font_fail(FONT_BAD_FILE, "the drawing cannot be written");
    return status;
}

enum font_status font_drawing_pdf(const struct font_drawing *d,
                                  const struct font_layout *layout, const struct font_map *map,
                                  double x, double y, FILE *file)
{
    const struct font_document_def def = {.title = d->title, .language = d->language};
    struct font_document *p;
    enum font_status status = font_document_create(&def, &p);
    if (status == FONT_OK)
        status = font_document_page(p, d, layout, map, x, y);
    if (status == FONT_OK)
        status = font_document_write(p, file);
    font_document_destroy(p);
    return status;
}
