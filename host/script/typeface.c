/* typeface.c - a whole typeface at a size as a mask, drawn on the OpenCL device, with a table
 * of its glyphs: typeface("EBGaramond12-Italic", {...}). */
#include "script_mask.h"

#include <edits.h>
#include <typeface.h>

#include <math.h>

/* What has to be freed, after an error too. */
struct making {
    struct font_face *face;
    struct font_typeface typeface;
};

static const char making_type[] = "lutetia typeface";

static void making_finish(struct making *m)
{
    font_typeface_finish(&m->typeface);
    font_face_close(m->face);
    m->face = NULL;
}

static int making_gc(lua_State *L)
{
    making_finish(luaL_checkudata(L, 1, making_type));
    return 0;
}

static struct making *making_new(lua_State *L)
{
    struct making *m = lua_newuserdatauv(L, sizeof *m, 0);
    *m = (struct making){0};
    luaL_setmetatable(L, making_type);
    return m;
}

/* Opens the font at 1, with the axes of the options at 2. */
static void face_open(lua_State *L, struct making *m)
{
    const char *font = script_font(L, luaL_checkstring(L, 1), "typeface font");
    enum font_status status = font_edits_open(font, 0, false, &m->face);
    script_edits_tell(L);
    if (status == FONT_OK)
        status = font_face_axes_set(m->face, script_arg_text(L, 2, "typeface", "axes"));
    if (status != FONT_OK)
        script_fail(L, font_error());
}

static void typeface_draw(lua_State *L, struct making *m, struct font_typeface_def *def)
{
    struct font_face_info info;
    script_memory_machine(L, "a typeface is drawn on the OpenCL device");
    script_memory_hold(L, font_typeface_work_bytes(m->face, def->size_px), "a typeface");
    def->pixels_bytes_max = fmax(1, script_memory_left(script_of(L)));
    font_simd_plain_here(true); /* what the device does not draw is so on every processor */
    const enum font_status status = font_typeface_draw(m->face, def, &m->typeface);
    font_simd_plain_here(false);
    script_memory_release(L, lua_gettop(L));
    lua_pop(L, 1);
    if (status != FONT_OK)
        script_fail(L, font_error());
    font_face_describe(m->face, &info);
    if (!m->typeface.inked_count)
        luaL_error(L, "%s: no glyph of it has an outline with ink", info.path);
}

/* Pushes the picture as a mask, which takes over the pixels. */
static void mask_push(lua_State *L, struct font_typeface *t)
{
    struct script_mask *mask = script_mask_new(L);
    mask->bytes = (double)t->width_px * t->height_px;
    mask->script->memory_bytes += (size_t)mask->bytes; /* within pixels_bytes_max */
    mask->width = t->width_px;
    mask->height = t->height_px;
    mask->gray = t->pixels;
    t->pixels = NULL;
}

static void glyph_push(lua_State *L, const struct font_face *face,
                       const struct font_typeface_glyph *g)
{
    const struct {
        const char *name;
        int value;
    } fields[] = {{"glyph", (int)g->glyph},
                  {"x", g->x},
                  {"y", g->y},
                  {"width", g->width_px},
                  {"height", g->height_px},
                  {"left", g->left_px},
                  {"top", g->top_px}};
    char name[FONT_GLYPH_NAME_BYTES];
    lua_createtable(L, 0, 10);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        lua_pushinteger(L, fields[i].value);
        lua_setfield(L, -2, fields[i].name);
    }
    lua_pushstring(L, font_face_glyph_name(face, g->glyph, name));
    lua_setfield(L, -2, "name");
    if (g->character) {
        lua_pushfstring(L, "%U", (long)g->character);
        lua_setfield(L, -2, "character");
    }
    lua_pushnumber(L, g->advance_px);
    lua_setfield(L, -2, "advance");
}

/* typeface("font" [, {size =, filter =, axes =}]): the mask of all glyphs, and a list of where
 * each is. */
static int make_typeface(lua_State *L)
{
    static const char *const keys[] = {"size", "filter", "axes", NULL};
    lua_settop(L, 2);
    luaL_checkstring(L, 1);
    script_arg_options(L, 2, "typeface", keys);
    struct font_typeface_def def = {.size_px = script_arg_number(L, 2, "typeface", "size", 24,
                                                                 FONT_TYPEFACE_LEAST_PX,
                                                                 FONT_TYPEFACE_MOST_PX),
                                    .filter = script_arg_text(L, 2, "typeface", "filter")};
    struct making *m = making_new(L);
    const int kept = lua_gettop(L);
    face_open(L, m);
    lua_settop(L, kept);
    typeface_draw(L, m, &def);
    mask_push(L, &m->typeface);
    lua_createtable(L, m->typeface.glyphs_count, 0);
    for (int i = 0; i < m->typeface.glyphs_count; i++) {
        script_check_row(L, i);
        glyph_push(L, m->face, &m->typeface.glyphs[i]);
        lua_rawseti(L, -2, i + 1);
    }
    making_finish(m);
    return 2;
}

const luaL_Reg script_typeface_makers[] = {{"typeface", make_typeface}, {NULL, NULL}};

void script_typeface_open(lua_State *L)
{
    script_type_open(L, making_type, making_gc);
}
