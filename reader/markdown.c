/* markdown.c - Markdown by cmark-gfm, its tree as blocks: see reader_document.h and
 * markdown_internal.h. */
#include "markdown_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_type(cmark_node *node, const char *type)
{
    return strcmp(cmark.node_get_type_string(node), type) == 0;
}

/* ---- blocks ---- */

/* Whether one of the words behind an info string's first is this one. */
static bool info_says(const char *info, const char *word)
{
    const size_t bytes = strlen(word);
    for (const char *at = info + strcspn(info, " \t"); *at; at += strcspn(at, " \t")) {
        at += strspn(at, " \t");
        if (strcspn(at, " \t") == bytes && strncmp(at, word, bytes) == 0)
            return true;
    }
    return false;
}

/* The stage that a fence's script or program has: the first word WIDTHxHEIGHT, within bounds,
 * or as usual. */
static void stage_read(const char *info, struct reader_block *block)
{
    block->stage_width = block->stage_program ? READER_STAGE_PROGRAM : READER_STAGE_WIDTH;
    block->stage_height = block->stage_program ? READER_STAGE_PROGRAM : READER_STAGE_HEIGHT;
    for (const char *at = info + strcspn(info, " \t"); *at; at += strcspn(at, " \t")) {
        int width = 0, height = 0, read = 0;
        at += strspn(at, " \t");
        const size_t bytes = strcspn(at, " \t");
        if (sscanf(at, "%5dx%5d%n", &width, &height, &read) != 2 || (size_t)read != bytes)
            continue;
        if (width >= READER_STAGE_LEAST && width <= READER_STAGE_MOST &&
            height >= READER_STAGE_LEAST && height <= READER_STAGE_MOST) {
            block->stage_width = width;
            block->stage_height = height;
        }
        return;
    }
}

/* Where text flows around its stage: of its info's words, those that say so. */
static void stage_beside(const char *info, struct reader_block *block)
{
    char words[64] = "";
    size_t used = 0;
    for (const char *at = info + strcspn(info, " \t"); *at;) {
        at += strspn(at, " \t");
        const size_t bytes = strcspn(at, " \t");
        const bool says = (bytes == 4 && strncmp(at, "left", 4) == 0) ||
                          (bytes == 5 && strncmp(at, "right", 5) == 0) ||
                          (bytes == 3 && at[2] == '%');
        if (says && used + bytes + 2 < sizeof words)
            used +=
                (size_t)snprintf(words + used, sizeof words - used, "%.*s ", (int)bytes, at);
        at += bytes;
    }
    reader_beside_read(words, &block->beside);
}

static void code_read(struct walk *w, cmark_node *node)
{
    const char *info = cmark.node_get_fence_info(node);
    size_t first = strcspn(info ? info : "", " \t");
    bool lua = info && first == 3 && strncmp(info, "lua", 3) == 0 && info_says(info, "live");
    bool live = lua || (info && first == 1 && *info == 'c' && info_says(info, "paris"));
    bool math = info && first == 4 && strncmp(info, "math", 4) == 0 &&
                strlen(cmark.node_get_literal(node)) <= READER_FORMULA_BYTES;
    walk_block_open(w, math ? READER_MATH : live ? READER_LIVE : READER_CODE_BLOCK, node);
    w->b.block.info = walk_copy(w, info);
    w->b.block.stage_program = live && !lua;
    if (live) {
        stage_read(info, &w->b.block);
        stage_beside(info, &w->b.block);
    }
    reader_code_add(&w->b, cmark.node_get_literal(node), math ? READER_FORMULA : READER_CODE);
    if (w->b.status == READER_OK)
        walk_line_end_drop(&w->b.block);
    reader_block_close(&w->b);
}

/* Where a link leads to that is all of its paragraph, and whose title says that it is included;
 * NULL: it is none. Neither in lists and quotes nor in notes. */
static const char *included_by(const struct walk *w, cmark_node *paragraph)
{
    cmark_node *child = cmark.node_first_child(paragraph);
    const bool link = child && !cmark.node_next(child) &&
                      cmark.node_get_type(child) == CMARK_NODE_LINK && !w->b.in_note &&
                      !w->b.items && !w->b.quotes;
    const char *title = link ? cmark.node_get_title(child) : NULL;
    return title && strcmp(title, "include") == 0 ? cmark.node_get_url(child) : NULL;
}

/* Its number or bullet; a task's box. */
static void item_begin(struct walk *w, cmark_node *node)
{
    struct list *list = w->lists_count ? &w->lists[w->lists_count - 1] : NULL;
    char marker[32] = "\xe2\x80\xa2";
    if (list && list->next >= 0)
        snprintf(marker, sizeof marker, "%ld%c", list->next++, list->bracket ? ')' : '.');
    if (is_type(node, "tasklist"))
        snprintf(marker, sizeof marker, "%s",
                 cmark.gfm_extensions_get_tasklist_item_checked(node) ? "\xe2\x98\x91"
                                                                      : "\xe2\x98\x90");
    reader_marker_set(&w->b, marker, cmark.node_get_start_line(node));
}

static void list_begin(struct walk *w, cmark_node *node)
{
    struct list list = {.next = -1};
    if (cmark.node_get_list_type(node) == CMARK_ORDERED_LIST)
        list = (struct list){cmark.node_get_list_start(node),
                             cmark.node_get_list_delim(node) == CMARK_PAREN_DELIM};
    if (!array_reserve(&w->lists, &w->lists_capacity, w->lists_count + 1, sizeof *w->lists)) {
        reader_builder_fail(&w->b);
        return;
    }
    w->lists[w->lists_count++] = list;
    w->b.items++;
}

/* What is left when one ends: an item without a block has an empty one. */
static void marker_flush(struct walk *w, cmark_node *node)
{
    if (!w->b.marker)
        return;
    walk_block_open(w, READER_PARAGRAPH, node);
    reader_block_close(&w->b);
}

static void row_begin(struct walk *w, cmark_node *node, bool head)
{
    struct reader_block *block = &w->b.block;
    int columns = cmark.gfm_extensions_get_table_columns(w->table);
    const uint8_t *aligns = cmark.gfm_extensions_get_table_alignments(w->table);
    walk_block_open(w, READER_ROW, node);
    block->table = w->b.document->tables_count - 1;
    block->head = head;
    block->columns = columns;
    for (int i = 0; i < READER_COLUMNS_MAX; i++)
        block->aligns[i] = i < columns && aligns && aligns[i] ? (char)aligns[i] : 'l';
}

/* A note's name stands before its definition's first letter: [^margin:name]: */
static void note_begin(struct walk *w, cmark_node *node)
{
    struct reader_document *d = w->b.document;
    struct reader_note note = {.first_block = d->note_blocks_count};
    int line = cmark.node_get_start_line(node);
    const char *at = "", *end = at;
    if (d->notes_count == READER_NOTES_MAX) {
        w->b.status = reader_fail(READER_TOO_LARGE,
                                  "a document has up to %d notes: part it into several files",
                                  READER_NOTES_MAX);
        return;
    }
    if (line >= 1 && line <= w->lines_count) {
        const char *from = w->b.source + w->lines[line - 1];
        const char *sign = strstr(from, "[^"), *close = sign ? strstr(sign, "]:") : NULL;
        const char *stop = strchr(from, '\n');
        if (close && (!stop || close < stop)) {
            at = sign + 2;
            end = close;
        }
    }
    const char *colon = memchr(at, ':', (size_t)(end - at));
    note.class = colon ? strndup(at, (size_t)(colon - at)) : strdup("");
    at = colon ? colon + 1 : at;
    note.name = strndup(at, (size_t)(end - at));
    if (!note.name || !note.class ||
        !array_reserve(&d->notes, &d->notes_capacity, d->notes_count + 1, sizeof *d->notes)) {
        free(note.name);
        free(note.class);
        reader_builder_fail(&w->b);
        return;
    }
    reader_block_close(&w->b);
    d->notes[d->notes_count++] = note;
    w->b.in_note = true;
    w->b.note_bytes = 0;
}

/* ---- letters ---- */

static void code_span_read(struct walk *w, cmark_node *node)
{
    reader_code_add(&w->b, cmark.node_get_literal(node), walk_look(w) | READER_CODE);
}

static void inline_enter(struct walk *w, cmark_node *node)
{
    struct reader_builder *b = &w->b;
    cmark_node_type type = cmark.node_get_type(node);
    const char *text = cmark.node_get_literal(node);
    if (type == CMARK_NODE_HTML_INLINE) {
        html_inline(w, text);
        return;
    }
    if (w->pictures)
        return;
    if (text || type == CMARK_NODE_LINEBREAK)
        walk_ends_add(w);
    if (type == CMARK_NODE_TEXT)
        reader_text_add(b, text, walk_look(w), walk_link(w));
    else if (type == CMARK_NODE_SOFTBREAK && !w->ends)
        reader_text_add(b, " ", walk_look(w), walk_link(w));
    else if (type == CMARK_NODE_LINEBREAK)
        reader_text_add(b, b->block.kind == READER_ROW ? " " : "\n", walk_look(w),
                        walk_link(w));
    else if (type == CMARK_NODE_CODE)
        code_span_read(w, node);
    else if (type == CMARK_NODE_FOOTNOTE_REFERENCE && text)
        reader_number_add(b, w->notes_before + atoi(text));
    else if (type == CMARK_NODE_EMPH)
        w->slanted++;
    else if (type == CMARK_NODE_STRONG)
        w->heavy++;
    else if (type == CMARK_NODE_LINK)
        w->link = cmark.node_get_url(node);
    else if (type == CMARK_NODE_IMAGE)
        picture_enter(w, node);
    else if (is_type(node, "strikethrough"))
        w->struck++;
}

static void inline_leave(struct walk *w, cmark_node *node)
{
    cmark_node_type type = cmark.node_get_type(node);
    if (type == CMARK_NODE_EMPH || type == CMARK_NODE_IMAGE)
        w->slanted--;
    if (type == CMARK_NODE_IMAGE)
        w->link = w->around;
    else if (type == CMARK_NODE_STRONG)
        w->heavy--;
    else if (type == CMARK_NODE_LINK)
        w->link = NULL;
    else if (is_type(node, "strikethrough"))
        w->struck--;
}

/* ---- the walk ---- */

static bool table_enter(struct walk *w, cmark_node *node)
{
    if (is_type(node, "table")) {
        w->b.document->tables_count++;
        w->table = node;
    } else if (is_type(node, "table_header") || is_type(node, "table_row")) {
        row_begin(w, node, is_type(node, "table_header"));
    } else if (is_type(node, "table_cell")) {
        if (cmark.node_previous(node))
            reader_cell_end(&w->b);
    } else {
        return false;
    }
    return true;
}

/* What ends in it is open no longer behind it. */
static bool holds_blocks(cmark_node *node)
{
    const cmark_node_type type = cmark.node_get_type(node);
    return type == CMARK_NODE_ITEM || type == CMARK_NODE_BLOCK_QUOTE ||
           type == CMARK_NODE_FOOTNOTE_DEFINITION || is_type(node, "tasklist");
}

static void block_enter(struct walk *w, cmark_node *node)
{
    cmark_node_type type = cmark.node_get_type(node);
    w->html.depth += holds_blocks(node);
    w->ends = 0;
    w->pictures = 0;
    html_looks_end(w);
    if (table_enter(w, node))
        return;
    if (type == CMARK_NODE_PARAGRAPH && !w->b.in_note && html_is_pictures(node)) {
        w->pictures = cmark.node_get_start_line(node);
    } else if (type == CMARK_NODE_PARAGRAPH) {
        cmark_node *picture = picture_of(w, node);
        walk_block_open(w, picture ? READER_PICTURE : READER_PARAGRAPH, node);
        if (picture) {
            w->b.block.target = walk_copy(w, cmark.node_get_url(picture));
            reader_beside_read(cmark.node_get_title(picture), &w->b.block.beside);
        }
        w->b.block.include = walk_copy(w, included_by(w, node));
    } else if (type == CMARK_NODE_HEADING) {
        walk_block_open(w, READER_HEADING, node);
        w->b.block.level = cmark.node_get_heading_level(node);
    } else if (type == CMARK_NODE_CODE_BLOCK) {
        code_read(w, node);
    } else if (type == CMARK_NODE_HTML_BLOCK) {
        html_block(w, node);
    } else if (type == CMARK_NODE_THEMATIC_BREAK) {
        walk_block_open(w, READER_RULE, node);
        reader_block_close(&w->b);
    } else if (type == CMARK_NODE_LIST) {
        list_begin(w, node);
    } else if (type == CMARK_NODE_ITEM || is_type(node, "tasklist")) {
        item_begin(w, node);
    } else if (type == CMARK_NODE_BLOCK_QUOTE) {
        w->b.quotes++;
    } else if (type == CMARK_NODE_FOOTNOTE_DEFINITION) {
        note_begin(w, node);
    }
}

static void block_leave(struct walk *w, cmark_node *node)
{
    cmark_node_type type = cmark.node_get_type(node);
    if (holds_blocks(node))
        html_container_end(w);
    if (type == CMARK_NODE_LIST) {
        w->lists_count -= w->lists_count > 0;
        w->b.items--;
    } else if (type == CMARK_NODE_ITEM || is_type(node, "tasklist")) {
        marker_flush(w, node);
    } else if (type == CMARK_NODE_BLOCK_QUOTE) {
        w->b.quotes--;
    } else if (type == CMARK_NODE_FOOTNOTE_DEFINITION) {
        w->b.in_note = false;
    } else if (!is_type(node, "table_cell") && !is_type(node, "table")) {
        reader_block_close(&w->b);
    }
}

static bool is_inline(cmark_node *node)
{
    return (cmark.node_get_type(node) & CMARK_NODE_TYPE_MASK) == CMARK_NODE_TYPE_INLINE;
}

static void tree_walk(struct walk *w, cmark_node *root)
{
    cmark_iter *iter = cmark.iter_new(root);
    cmark_event_type event;
    while (w->b.status == READER_OK && (event = cmark.iter_next(iter)) != CMARK_EVENT_DONE) {
        cmark_node *node = cmark.iter_get_node(iter);
        if (w->told) { /* nothing of what is in it */
            if (node == w->told)
                w->told = NULL;
        } else if (is_inline(node) && !is_type(node, "table_cell"))
            (event == CMARK_EVENT_ENTER ? inline_enter : inline_leave)(w, node);
        else
            (event == CMARK_EVENT_ENTER ? block_enter : block_leave)(w, node);
    }
    cmark.iter_free(iter);
    html_close_to(w, 0);
    html_looks_end(w);
    reader_block_close(&w->b);
    reader_labels_end(&w->b);
}

/* Owns: the caller frees it. */
static cmark_node *tree_make(const char *masked, size_t bytes)
{
    static const char *const extensions[] = {"table", "strikethrough", "autolink", "tasklist"};
    cmark_parser *parser = cmark.parser_new(CMARK_OPT_FOOTNOTES | CMARK_OPT_VALIDATE_UTF8);
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++) {
        cmark_syntax_extension *extension = cmark.find_syntax_extension(extensions[i]);
        if (extension)
            cmark.parser_attach_syntax_extension(parser, extension);
    }
    cmark.parser_feed(parser, masked, bytes);
    cmark_node *root = cmark.parser_finish(parser);
    cmark.parser_free(parser);
    return root;
}

static int *lines_find(const char *source, int bytes, int *count)
{
    int lines = 1;
    for (int i = 0; i < bytes; i++)
        lines += source[i] == '\n';
    int *begins = malloc((size_t)lines * sizeof *begins);
    *count = 0;
    if (!begins)
        return NULL;
    begins[(*count)++] = 0;
    for (int i = 0; i < bytes; i++)
        if (source[i] == '\n')
            begins[(*count)++] = i + 1;
    return begins;
}

/* A copy that ends, without zeros. Owns: the caller frees it. */
static char *source_copy(const char *utf8, size_t bytes)
{
    char *source = malloc(bytes + 1);
    if (!source)
        return NULL;
    memcpy(source, utf8, bytes);
    source[bytes] = '\0';
    for (size_t i = 0; i < bytes; i++)
        if (!source[i])
            source[i] = ' ';
    return source;
}

enum reader_status reader_document_add(struct reader_document *d, const char *utf8,
                                       size_t bytes)
{
    struct reader_mask mask = {0};
    struct walk w = {.b.status = READER_OK, .notes_before = d->notes_count};
    const char *why;
    if (d->referred)
        return reader_fail(READER_BAD_ARGUMENT, "references have their names already");
    if (!cmark_load(&why))
        return reader_fail(
            READER_NO_LIBRARY,
            "Markdown is read by cmark-gfm, which cannot be loaded (%s): install "
            "libcmark-gfm and libcmark-gfm-extensions",
            why);
    if (bytes > READER_BYTES_MAX)
        return reader_fail(READER_TOO_LARGE, "a document has up to %d MB (this one has %zu)",
                           READER_BYTES_MAX >> 20, bytes >> 20);
    char *source = source_copy(utf8, bytes);
    int *lines = source ? lines_find(source, (int)bytes, &w.lines_count) : NULL;
    w.b.document = d;
    w.b.source = source;
    w.b.mask = &mask;
    w.lines = lines;
    if (!lines)
        reader_builder_fail(&w.b);
    if (w.b.status == READER_OK)
        w.b.status = reader_guard_check(source, (int)bytes);
    if (w.b.status == READER_OK)
        w.b.status = reader_mask_make(source, (int)bytes, &mask);
    if (w.b.status == READER_OK) {
        cmark_node *root = tree_make(mask.masked, bytes);
        tree_walk(&w, root);
        cmark.node_free(root);
        d->sources_count++;
    }
    reader_block_finish(&w.b.block);
    reader_mask_finish(&mask);
    free(w.b.marker);
    free(w.lists);
    free(lines);
    free(source);
    return w.b.status;
}
