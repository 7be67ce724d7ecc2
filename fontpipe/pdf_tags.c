/* pdf_tags.c - what the pages' texts are, as a tree; the document's outline, its title: see
 * pdf_internal.h.
 *
 * Each paragraph is an element, on however many pages it stands: its marks are contents of
 * pages, numbered on each. Items in a row are a list. Headings are made one level deeper at a
 * time, since that is what readers expect. */
#include "pdf_internal.h"

#define NOTE_NAME "note-%08d"

#include <stdlib.h>
#include <string.h>

static int element_find(struct font_document *p, const struct font_passage *passage)
{
    for (int i = p->elements_count - 1; passage->paragraph >= 0 && i >= 0; i--)
        if (p->elements[i].paragraph == passage->paragraph)
            return i;
    if (!array_reserve(&p->elements, &p->elements_capacity, p->elements_count + 1,
                       sizeof *p->elements))
        return -1;
    p->elements[p->elements_count] = (struct pdf_element){.role = passage->role,
                                                          .level = passage->level,
                                                          .paragraph = passage->paragraph,
                                                          .first = -1,
                                                          .last = -1};
    return p->elements_count++;
}

int pdf_mark_begin(struct font_document *p, const struct font_drawing *d,
                   const struct font_passage *passage, double top)
{
    int element = element_find(p, passage), mark = p->marks_count;
    if (element < 0 ||
        !array_reserve(&p->marks, &p->marks_capacity, mark + 1, sizeof *p->marks))
        return -1;
    struct pdf_element *e = &p->elements[element];
    p->marks[p->marks_count++] =
        (struct pdf_mark){.element = element, .page = p->pages_count, .next = -1};
    if (e->last >= 0)
        p->marks[e->last].next = mark;
    else
        e->first = mark;
    e->last = mark;
    if (e->role == FONT_ROLE_HEADING && !e->bytes) {
        e->top = top;
        e->bytes = passage->end - passage->begin;
        while (e->bytes && (unsigned char)d->text[passage->begin + e->bytes - 1] <= ' ')
            e->bytes--;
        e->said = pdf_say(p, d->text + passage->begin, e->bytes);
    }
    p->tagged = true;
    return mark;
}

const char *pdf_tag(const struct pdf_element *e, char room[8])
{
    static const char *const names[] = {[FONT_ROLE_PARAGRAPH] = "P",
                                        [FONT_ROLE_ITEM] = "LBody",
                                        [FONT_ROLE_QUOTE] = "P",
                                        [FONT_ROLE_NOTE] = "Note"};
    if (e->role != FONT_ROLE_HEADING)
        return names[e->role];
    snprintf(room, 8, "H%d", e->level < 1 ? 1 : e->level > 6 ? 6 : e->level);
    return room;
}

/* ---- the tree ---- */

/* The elements that the document's own children are: of items in a row the list. */
struct tree {
    int root, document;
    int *children;
    int count, capacity;
};

static bool child_add(struct tree *t, int number)
{
    if (!array_reserve(&t->children, &t->capacity, t->count + 1, sizeof *t->children))
        return false;
    t->children[t->count++] = number;
    return true;
}

static void marks_put(struct font_document *p, const struct pdf_element *e)
{
    fputs(" /K [", p->f);
    for (int m = e->first; m >= 0; m = p->marks[m].next) {
        const struct pdf_page *page = &p->pages[p->marks[m].page];
        fprintf(p->f, " << /Type /MCR /Pg %d 0 R /MCID %d >>", page->number,
                m - page->marks_begin);
    }
    fputs(" ]", p->f);
}

static void element_put(struct font_document *p, const struct pdf_element *e, int parent)
{
    char room[8];
    pdf_object_begin(p, e->number);
    fprintf(p->f, "<< /Type /StructElem /S /%s /P %d 0 R", pdf_tag(e, room), parent);
    if (e->role == FONT_ROLE_NOTE)
        fprintf(p->f, " /ID (" NOTE_NAME ")", e->number);
    marks_put(p, e);
    fputs(" >>\nendobj\n", p->f);
}

/* An element that has others: a list, an item, a quote. */
static void group_put(struct font_document *p, int number, const char *tag, int parent,
                      const int *children, int count)
{
    pdf_object_begin(p, number);
    fprintf(p->f, "<< /Type /StructElem /S /%s /P %d 0 R /K [", tag, parent);
    for (int i = 0; i < count; i++)
        fprintf(p->f, " %d 0 R", children[i]);
    fputs(" ] >>\nendobj\n", p->f);
}

/* A list of the items from element i on; how many. */
static int list_put(struct font_document *p, struct tree *t, int i)
{
    int list = pdf_object(p), n = 0;
    while (i + n < p->elements_count && p->elements[i + n].role == FONT_ROLE_ITEM)
        n++;
    int *items = calloc((size_t)n + 1, sizeof *items);
    p->failed = p->failed || !items || !child_add(t, list);
    for (int k = 0; items && k < n; k++) {
        items[k] = pdf_object(p);
        element_put(p, &p->elements[i + k], items[k]);
        group_put(p, items[k], "LI", list, &p->elements[i + k].number, 1);
    }
    if (items)
        group_put(p, list, "L", t->document, items, n);
    free(items);
    return n;
}

static void elements_put(struct font_document *p, struct tree *t)
{
    int depth = 0;
    for (int i = 0; i < p->elements_count; i++) {
        struct pdf_element *e = &p->elements[i];
        e->number = pdf_object(p);
        if (e->role == FONT_ROLE_HEADING) {
            e->level = e->level > depth + 1 ? depth + 1 : e->level < 1 ? 1 : e->level;
            depth = e->level;
        }
    }
    for (int i = 0; i < p->elements_count;) {
        struct pdf_element *e = &p->elements[i];
        if (e->role == FONT_ROLE_ITEM) {
            i += list_put(p, t, i);
            continue;
        }
        int parent = t->document;
        if (e->role == FONT_ROLE_QUOTE) {
            parent = pdf_object(p);
            group_put(p, parent, "BlockQuote", t->document, &e->number, 1);
        }
        element_put(p, e, parent);
        p->failed = p->failed || !child_add(t, parent == t->document ? e->number : parent);
        i++;
    }
}

/* Notes by their names, which are sorted as their numbers are; 0: there are none. */
static int names_put(struct font_document *p)
{
    int number = 0;
    for (int i = 0; i < p->elements_count; i++) {
        const struct pdf_element *e = &p->elements[i];
        if (e->role != FONT_ROLE_NOTE)
            continue;
        if (!number) {
            number = pdf_object(p);
            pdf_object_begin(p, number);
            fputs("<< /Names [", p->f);
        }
        fprintf(p->f, "\n(" NOTE_NAME ") %d 0 R", e->number, e->number);
    }
    if (number)
        fputs(" ] >>\nendobj\n", p->f);
    return number;
}

/* Which element each mark of each page is of. */
static int parents_put(struct font_document *p)
{
    int number = pdf_object(p);
    pdf_object_begin(p, number);
    fputs("<< /Nums [", p->f);
    for (int k = 0; k < p->pages_count; k++) {
        const struct pdf_page *page = &p->pages[k];
        fprintf(p->f, "\n%d [", k);
        for (int m = 0; m < page->marks_count; m++)
            fprintf(p->f, " %d 0 R",
                    p->elements[p->marks[page->marks_begin + m].element].number);
        fputs(" ]", p->f);
    }
    fputs(" ] >>\nendobj\n", p->f);
    return number;
}

static int tree_put(struct font_document *p)
{
    struct tree t = {.root = pdf_object(p), .document = pdf_object(p)};
    elements_put(p, &t);
    int parents = parents_put(p), names = names_put(p);
    group_put(p, t.document, "Document", t.root, t.children, t.count);
    pdf_object_begin(p, t.root);
    fprintf(p->f,
            "<< /Type /StructTreeRoot /K [%d 0 R] /ParentTree %d 0 R /ParentTreeNextKey %d",
            t.document, parents, p->pages_count);
    if (names)
        fprintf(p->f, " /IDTree %d 0 R", names);
    fputs(" >>\nendobj\n", p->f);
    free(t.children);
    return t.root;
}

/* ---- the outline ---- */

struct head {
    int element, number, parent, before, next, first, last, inside; /* of heads; -1: none */
};

/* Each head's neighbours: it lies in the nearest one before it of a lower level. */
static void heads_link(const struct font_document *p, struct head *heads, int count)
{
    for (int i = 0; i < count; i++) {
        int level = p->elements[heads[i].element].level, at = i - 1;
        while (at >= 0 && p->elements[heads[at].element].level >= level)
            at = heads[at].parent;
        heads[i].parent = at;
        heads[i].before = -1;
        if (at >= 0) {
            heads[i].before = heads[at].last;
            heads[at].last = i;
            if (heads[at].first < 0)
                heads[at].first = i;
        } else {
            for (int k = i - 1; k >= 0 && heads[i].before < 0; k--)
                if (heads[k].parent < 0)
                    heads[i].before = k;
        }
        if (heads[i].before >= 0)
            heads[heads[i].before].next = i;
    }
    for (int i = count - 1; i >= 0; i--)
        if (heads[i].parent >= 0)
            heads[heads[i].parent].inside += 1 + heads[i].inside;
}

static void link_put(const struct font_document *p, const char *name, const struct head *heads,
                     int at)
{
    if (at >= 0)
        fprintf(p->f, " /%s %d 0 R", name, heads[at].number);
}

static void head_put(struct font_document *p, const struct head *heads, int i, int root)
{
    const struct head *h = &heads[i];
    const struct pdf_element *e = &p->elements[h->element];
    const struct pdf_page *page = &p->pages[p->marks[e->first].page];
    pdf_object_begin(p, h->number);
    fputs("<< /Title ", p->f);
    pdf_text_put(p->said + e->said, e->bytes, p->f);
    fprintf(p->f, " /Parent %d 0 R /Dest [%d 0 R /XYZ null %.7g null]",
            h->parent < 0 ? root : heads[h->parent].number, page->number, e->top);
    link_put(p, "Prev", heads, h->before);
    link_put(p, "Next", heads, h->next);
    link_put(p, "First", heads, h->first);
    link_put(p, "Last", heads, h->last);
    if (h->inside)
        fprintf(p->f, " /Count %d", h->inside);
    fputs(" >>\nendobj\n", p->f);
}

static int outline_put(struct font_document *p)
{
    struct head *heads = calloc((size_t)p->elements_count + 1, sizeof *heads);
    int count = 0, root = 0, last = -1;
    p->failed = p->failed || !heads;
    for (int i = 0; heads && i < p->elements_count; i++)
        if (p->elements[i].role == FONT_ROLE_HEADING && p->elements[i].bytes)
            heads[count++] = (struct head){
                .element = i, .number = pdf_object(p), .next = -1, .first = -1, .last = -1};
    if (count) {
        root = pdf_object(p);
        heads_link(p, heads, count);
        for (int i = 0; i < count; i++) {
            head_put(p, heads, i, root);
            last = heads[i].parent < 0 ? i : last;
        }
        pdf_object_begin(p, root);
        fprintf(p->f, "<< /Type /Outlines /First %d 0 R /Last %d 0 R /Count %d >>\nendobj\n",
                heads[0].number, heads[last].number, count);
    }
    free(heads);
    return root;
}

/* ---- the title ---- */

/* A text in XML, without what XML has not. */
static void xml_put(const char *text, FILE *f)
{
    const char *at = text, *end = text + strlen(text);
    while (at < end) {
        const char *from = at;
        uint32_t c;
        bool good = font_utf8_next(&at, end, &c);
        if (!good || c == 0xfffe || c == 0xffff)
            fputs("\xef\xbf\xbd", f);
        else if (c < ' ')
            fputc(' ', f);
        else if (c == '<' || c == '&' || c == '>')
            fprintf(f, "&#%d;", (int)c);
        else
            fwrite(from, 1, (size_t)(at - from), f);
    }
}

static int metadata_put(struct font_document *p)
{
    char *bytes = NULL;
    size_t count = 0;
    int number = pdf_object(p);
    FILE *f = open_memstream(&bytes, &count);
    if (!f) {
        p->failed = true;
        return number;
    }
    fputs("<?xpacket begin=\"\xef\xbb\xbf\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n<x:xmpmeta "
          "xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
          "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n<rdf:Description "
          "rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\" "
          "xmlns:pdf=\"http://ns.adobe.com/pdf/1.3/\">\n",
          f);
    if (p->title) {
        fputs("<dc:title><rdf:Alt><rdf:li xml:lang=\"x-default\">", f);
        xml_put(p->title, f);
        fputs("</rdf:li></rdf:Alt></dc:title>\n", f);
    }
    if (p->language) {
        fputs("<dc:language><rdf:Bag><rdf:li>", f);
        xml_put(p->language, f);
        fputs("</rdf:li></rdf:Bag></dc:language>\n", f);
    }
    fputs("<pdf:Producer>Lutetia</pdf:Producer>\n</rdf:Description></rdf:RDF></x:xmpmeta>\n"
          "<?xpacket end=\"w\"?>",
          f);
    p->failed = fclose(f) != 0 || p->failed;
    pdf_object_begin(p, number);
    fprintf(p->f, "<< /Type /Metadata /Subtype /XML /Length %zu >>\nstream\n", count);
    fwrite(bytes, 1, bytes ? count : 0, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    free(bytes);
    return number;
}

void pdf_tags_put(struct font_document *p, struct pdf_catalog *out)
{
    if (p->tagged)
        out->tags = tree_put(p);
    out->outline = outline_put(p);
    out->metadata = metadata_put(p);
    out->info = pdf_object(p);
    pdf_object_begin(p, out->info);
    fputs("<< /Producer (Lutetia)", p->f);
    if (p->title) {
        fputs(" /Title ", p->f);
        pdf_text_put(p->title, strlen(p->title), p->f);
    }
    fputs(" >>\nendobj\n", p->f);
}
