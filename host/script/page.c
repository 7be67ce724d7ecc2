/* page.c - a page of type as a mask: page("text", {...}). */
#include "script_mask.h"

#include <paint.h>
#include <setup.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS_MAX = 400, LETTER_BYTES = 200 };

/* What the arguments say; nothing of it has to be freed. */
struct wanted {
    struct page_setup setup;
    struct page_shape shapes[2];
    double corners[2][2 * CORNERS_MAX];
    int page;
    double x, y;
    const char *filter;
    double darken_px;
};

/* around = {{x, y}, ...}, in the page's places. */
static void shape_read(lua_State *L, int index, const char *name, struct wanted *w, bool inside)
{
    if (lua_isnoneornil(L, index) || lua_getfield(L, index, name) == LUA_TNIL)
        return;
    int table = lua_gettop(L), n = w->setup.shapes_count;
    if (!lua_istable(L, table) || lua_rawlen(L, table) < 3 ||
        lua_rawlen(L, table) > CORNERS_MAX)
        luaL_error(L, "page %s must be 3..%d points: {{x, y}, {x, y}, ...}", name, CORNERS_MAX);
    int count = (int)lua_rawlen(L, table);
    for (int i = 0; i < count; i++) {
        if (lua_rawgeti(L, table, i + 1) != LUA_TTABLE)
            luaL_error(L, "point %d of page %s must be {x, y}", i + 1, name);
        for (int k = 0; k < 2; k++) {
            lua_rawgeti(L, -1, k + 1);
            w->corners[n][2 * i + k] =
                script_arg_at(L, -1, "page's point", -SCRIPT_PLACE_MAX, SCRIPT_PLACE_MAX);
            lua_pop(L, 1);
        }
        lua_pop(L, 1);
    }
    lua_settop(L, table - 1);
    w->shapes[n] = (struct page_shape){.points = w->corners[n],
                                       .points_count = count,
                                       .inside = inside,
                                       .distance_px = inside ? 0 : w->setup.size_px / 2};
    w->setup.shapes_count++;
}

static const char *font_read(lua_State *L, int index, const char *name, const char *usual)
{
    const char *font = script_arg_text(L, index, "page", name);
    char what[32];
    snprintf(what, sizeof what, "page %.20s", name);
    return font ? script_font(L, font, what) : usual;
}

static void numbers_read(lua_State *L, int index, struct page_setup *s)
{
    for (int i = 0; i < page_numbers_count; i++) {
        const struct page_number *n = &page_numbers[i];
        void *at = (char *)s + n->at;
        if (n->whole)
            *(int *)at =
                script_arg_integer(L, index, "page", n->name, *(int *)at, n->least, n->most);
        else
            *(double *)at =
                script_arg_number(L, index, "page", n->name, *(double *)at, n->least, n->most);
    }
}

static void wanted_read(lua_State *L, int index, struct wanted *w)
{
    static const char *const keys[] = {
        "width",     "height",    "margin",   "columns",  "gap",    "size",     "font",
        "italic",    "bold",      "leading",  "align",    "indent", "notes",    "page",
        "hyphenate", "language",  "features", "protrude", "expand", "vertical", "around",
        "inside",    "x",         "y",        "filter",   "darken", "grid",     "folios",
        "head",      "tolerance", NULL};
    static const char *const fonts[] = {"EBGaramond12-Regular", "DejaVuSerif", NULL};
    const double far = SCRIPT_PLACE_MAX;
    struct page_setup *s = &w->setup;
    *s = page_setup_default();
    script_arg_options(L, index, "page", keys);
    s->size_px = 24;
    s->margin_px = s->gap_px = -1; /* by the size */
    numbers_read(L, index, s);
    s->margin_px = s->margin_px < 0 ? 2 * s->size_px : s->margin_px;
    s->gap_px = s->gap_px < 0 ? s->size_px : s->gap_px;
    s->hyphenate = script_arg_boolean(L, index, "page", "hyphenate", false);
    s->vertical = script_arg_boolean(L, index, "page", "vertical", false);
    s->grid = script_arg_boolean(L, index, "page", "grid", false);
    s->folios = script_arg_boolean(L, index, "page", "folios", false);
    s->head = script_arg_text(L, index, "page", "head");
    s->language = script_arg_text(L, index, "page", "language");
    s->features = script_arg_text(L, index, "page", "features");
    s->font = font_read(L, index, "font", NULL);
    if (!s->font)
        s->font = font_face_first(fonts);
    s->italic = font_read(L, index, "italic", NULL);
    s->bold = font_read(L, index, "bold", NULL);
    w->page = script_arg_integer(L, index, "page", "page", 1, 1, 99999);
    w->x = script_arg_number(L, index, "page", "x", 0, -far, far);
    w->y = script_arg_number(L, index, "page", "y", 0, -far, far);
    w->filter = script_arg_text(L, index, "page", "filter");
    w->darken_px = script_arg_number(L, index, "page", "darken", 0, 0, 2);
    const char *align = script_arg_text(L, index, "page", "align");
    if (align && !font_align_named(align, &s->align))
        luaL_error(
            L, "page align must be \"left\", \"center\", \"right\" or \"justify\" (got '%s')",
            align);
    shape_read(L, index, "around", w, false);
    shape_read(L, index, "inside", w, true);
    s->shapes = w->shapes;
}

/* The page's coverage; *pages: how many there are. *layout: its glyphs, the caller's. */
static enum font_status page_cover(const struct wanted *w, const char *text, size_t bytes,
                                   struct font_cover *cover, int *pages,
                                   struct font_layout *layout)
{
    struct page_text *set = NULL;
    struct font_painter *painter = NULL;
    struct font_painter_def def = font_painter_def_default();
    def.filter = w->filter ? w->filter : "box";
    def.darken_px = w->darken_px;
    enum font_status status = page_setup_make(&w->setup, text, bytes, &set);
    if (status == FONT_OK)
        status = page_count(set, pages);
    if (status == FONT_OK && w->page <= *pages)
        status = page_layout(set, w->page - 1, layout);
    if (status == FONT_OK)
        status = font_painter_create(&def, &painter);
    if (status == FONT_OK)
        status = font_painter_cover(painter, layout, NULL, 0, 0, cover);
    font_painter_destroy(painter);
    page_text_destroy(set);
    return status;
}

/* page("text", {...}): the mask of one page, and how many pages there are. Pages beyond the
 * last are blank. */
static int make_page(lua_State *L)
{
    size_t bytes;
    int pages = 0;
    struct wanted w = {.page = 1};
    lua_settop(L, 2);
    const char *text = luaL_checklstring(L, 1, &bytes);
    wanted_read(L, 2, &w);
    double work = LETTER_BYTES * (double)bytes + 16 * w.setup.size_px * w.setup.size_px;
    script_memory_hold(L, work, "a page");
    const int hold = lua_gettop(L);
    struct script_mask *mask = script_mask_gray_new(
        L, floor(w.setup.width_px), floor(w.setup.height_px), floor(w.x), floor(w.y));
    struct font_cover cover = {mask->width, mask->height, mask->width, mask->gray};
    font_simd_plain_here(true); /* a sheet is the same on every processor */
    struct font_layout layout = {0};
    enum font_status status = page_cover(&w, text, bytes, &cover, &pages, &layout);
    struct font_layout lacks = layout;
    font_layout_finish(&layout);
    font_simd_plain_here(false);
    script_memory_release(L, hold);
    script_edits_tell(L);
    script_missing_tell(L, w.setup.font, lacks.missing, lacks.missing_count);
    if (status != FONT_OK)
        script_fail(L, font_error());
    lua_pushinteger(L, pages);
    script_check(L);
    return 2;
}

const luaL_Reg script_page_makers[] = {{"page", make_page}, {NULL, NULL}};
