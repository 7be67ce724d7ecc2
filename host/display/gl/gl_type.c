/* gl_type.c - see gl_type.h. A page of the atlas is a texture of coverage; vertices are
 * given in pixels and converted to the viewport here, so there are no matrices. Quads are
 * drawn page by page. */
#include "gl_type.h"
#include "display_internal.h"
#include "gl_ink.h"
#include "gl_light.h"
#include <colour.h>

#include <stdlib.h>

enum { QUADS = 1024, PAGES_MAX = 64 };

#define GL_FUNCTIONS(X)                                                                        \
    X(void, Begin, (GLenum))                                                                   \
    X(void, BindTexture, (GLenum, GLuint))                                                     \
    X(void, BlendFuncSeparate, (GLenum, GLenum, GLenum, GLenum))                               \
    X(void, Color3f, (GLfloat, GLfloat, GLfloat))                                              \
    X(void, Color4f, (GLfloat, GLfloat, GLfloat, GLfloat))                                     \
    X(void, DeleteTextures, (GLsizei, const GLuint *))                                         \
    X(void, Disable, (GLenum))                                                                 \
    X(void, Enable, (GLenum))                                                                  \
    X(void, End, (void))                                                                       \
    X(void, GenTextures, (GLsizei, GLuint *))                                                  \
    X(GLenum, GetError, (void))                                                                \
    X(void, GetIntegerv, (GLenum, GLint *))                                                    \
    X(void, PixelStorei, (GLenum, GLint))                                                      \
    X(void, TexCoord2f, (GLfloat, GLfloat))                                                    \
    X(void, TexEnvi, (GLenum, GLenum, GLint))                                                  \
    X(void, TexImage2D,                                                                        \
      (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *))           \
    X(void, TexParameteri, (GLenum, GLenum, GLint))                                            \
    X(void, TexSubImage2D,                                                                     \
      (GLenum, GLint, GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, const void *))           \
    X(void, Vertex2f, (GLfloat, GLfloat))

#include "gl_functions.h"

struct gl_type {
    struct gl gl;
    void (*(*function)(const char *name))(void);
    struct font_atlas *atlas;
    struct font_atlas_def def;
    struct font_painter *painter; /* of glyphs that are pictures, once there is one */
    struct gl_ink *ink;           /* of gradients and pictures, once there is one */
    GLuint textures[PAGES_MAX];
    int textures_count;
    int width_px, height_px; /* of the viewport */
    bool light;              /* the framebuffer is encoded as sRGB */
    struct font_quad quads[QUADS];
    float colors[QUADS][4]; /* colours of quads that have their own */
};

struct gl_type_def gl_type_def_default(void)
{
    return (struct gl_type_def){.atlas = font_atlas_def_default()};
}

static enum display_status fail_font(enum font_status status)
{
    return display_fail(status == FONT_NO_MEMORY ? DISPLAY_NO_MEMORY : DISPLAY_BAD_ARGUMENT,
                        "%s", font_error());
}

enum display_status gl_type_create(const struct gl_type_def *def, struct gl_type **out)
{
    GLint side_max = 0;
    *out = NULL;
    struct gl_type *t = calloc(1, sizeof *t);
    if (!t)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for type on a display");
    t->def = def->atlas;
    t->def.filter = NULL;
    t->function = def->function;
    enum display_status status = DISPLAY_OK;
    if (!def->function || !gl_functions_find(&t->gl, def->function))
        status = display_fail(DISPLAY_NO_WINDOW, "no type: this display has no OpenGL 2.1");
    if (status == DISPLAY_OK) {
        t->gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &side_max);
        if (t->def.width_px > side_max || t->def.height_px > side_max)
            status =
                display_fail(DISPLAY_BAD_ARGUMENT,
                             "a page of %dx%d pixels is too large for this display: %d a side",
                             t->def.width_px, t->def.height_px, (int)side_max);
    }
    if (status == DISPLAY_OK) {
        enum font_status made = font_atlas_create(&def->atlas, &t->atlas);
        status = made == FONT_OK ? DISPLAY_OK : fail_font(made);
    }
    if (status == DISPLAY_OK)
        *out = t;
    else
        gl_type_destroy(t);
    return status;
}

void gl_type_destroy(struct gl_type *t)
{
    if (!t)
        return;
    if (t->textures_count)
        t->gl.DeleteTextures(t->textures_count, t->textures);
    font_atlas_destroy(t->atlas);
    font_painter_destroy(t->painter);
    gl_ink_destroy(t->ink);
    free(t);
}

struct font_atlas *gl_type_atlas(struct gl_type *t)
{
    return t->atlas;
}

/* ---- a frame ---- */

void gl_type_begin(struct gl_type *t, int width_px, int height_px)
{
    t->width_px = width_px;
    t->height_px = height_px;
    t->light = gl_light_mixed(t->function);
    font_atlas_begin(t->atlas);
}

/* Copies what is new on the atlas's pages into the textures. */
static enum display_status textures_update(struct gl_type *t)
{
    const struct gl *gl = &t->gl;
    struct font_atlas_box box;
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int page = 0; page < font_atlas_pages(t->atlas); page++) {
        if (page == t->textures_count) {
            gl->GenTextures(1, &t->textures[t->textures_count++]);
            gl->BindTexture(GL_TEXTURE_2D, t->textures[page]);
            gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
            gl->TexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA8, t->def.width_px, t->def.height_px, 0,
                           GL_ALPHA, GL_UNSIGNED_BYTE, font_atlas_pixels(t->atlas, page));
            while (font_atlas_dirty(t->atlas, page, &box))
                ;
        }
        gl->BindTexture(GL_TEXTURE_2D, t->textures[page]);
        gl->PixelStorei(GL_UNPACK_ROW_LENGTH, t->def.width_px);
        while (font_atlas_dirty(t->atlas, page, &box))
            gl->TexSubImage2D(GL_TEXTURE_2D, 0, box.x, box.y, box.width, box.height, GL_ALPHA,
                              GL_UNSIGNED_BYTE,
                              font_atlas_pixels(t->atlas, page) +
                                  (size_t)box.y * (size_t)t->def.width_px + (size_t)box.x);
        gl->PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    }
    return gl->GetError() == GL_NO_ERROR
               ? DISPLAY_OK
               : display_fail(DISPLAY_NO_MEMORY,
                              "the display has no memory for pages of %dx%d pixels",
                              t->def.width_px, t->def.height_px);
}

static void corner(const struct gl_type *t, float x, float y, float u, float v)
{
    t->gl.TexCoord2f(u, v);
    t->gl.Vertex2f(2 * x / (float)t->width_px - 1, 1 - 2 * y / (float)t->height_px);
}

static void quads_draw(const struct gl_type *t, int count)
{
    for (int page = 0; page < t->textures_count; page++) {
        t->gl.BindTexture(GL_TEXTURE_2D, t->textures[page]);
        t->gl.Begin(GL_QUADS);
        for (int i = 0; i < count; i++) {
            const struct font_quad *q = &t->quads[i];
            if (q->page != page)
                continue;
            corner(t, q->x0, q->y0, q->u0, q->v0);
            corner(t, q->x1, q->y0, q->u1, q->v0);
            corner(t, q->x1, q->y1, q->u1, q->v1);
            corner(t, q->x0, q->y1, q->u0, q->v1);
        }
        t->gl.End();
    }
}

/* Converts a colour's component to the numbers that the framebuffer mixes. */
static float mixed(const struct gl_type *t, double number)
{
    return (float)(t->light ? font_light(number, 0) : number);
}

/* Draws quads from `first` to before `end` in their order, each in its own colour. */
static void quads_draw_in_order(const struct gl_type *t, int first, int end)
{
    int bound = -1;
    for (int i = first; i < end; i++) {
        const struct font_quad *q = &t->quads[i];
        if (q->page != bound) {
            if (bound >= 0)
                t->gl.End();
            t->gl.BindTexture(GL_TEXTURE_2D, t->textures[q->page]);
            t->gl.Begin(GL_QUADS);
            bound = q->page;
        }
        t->gl.Color4f(t->colors[i][0], t->colors[i][1], t->colors[i][2], t->colors[i][3]);
        corner(t, q->x0, q->y0, q->u0, q->v0);
        corner(t, q->x1, q->y0, q->u1, q->v0);
        corner(t, q->x1, q->y1, q->u1, q->v1);
        corner(t, q->x0, q->y1, q->u0, q->v1);
    }
    if (bound >= 0)
        t->gl.End();
}

static void state_set(const struct gl_type *t)
{
    const struct gl *gl = &t->gl;
    gl->Enable(GL_TEXTURE_2D);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
    if (t->light)
        gl->Enable(GL_FRAMEBUFFER_SRGB);
}

static void state_reset(const struct gl_type *t)
{
    t->gl.Disable(GL_BLEND);
    t->gl.Disable(GL_TEXTURE_2D);
    if (t->light)
        t->gl.Disable(GL_FRAMEBUFFER_SRGB);
}

/* Draws quads of the layout's inks in their order. Those that follow each other are drawn at
 * once if their inks are plain and mixed alike, or the same. */
static enum display_status inked_draw(struct gl_type *t, const struct font_layout *layout,
                                      const double ink[3], double x_px, double y_px, int count)
{
    const struct font_ink plain = font_ink_plain(ink[0], ink[1], ink[2], 1);
    enum display_status status = DISPLAY_OK;
    for (int first = 0, end = 0; first < count && status == DISPLAY_OK; first = end) {
        const struct font_ink *own = NULL;
        bool light = false;
        for (; end < count; end++) {
            const struct font_ink *next =
                t->quads[end].ink > 0 ? &layout->inks[t->quads[end].ink - 1] : &plain;
            if (own && own != next &&
                (own->kind != FONT_INK_PLAIN || next->kind != FONT_INK_PLAIN ||
                 own->numbers != next->numbers))
                break;
            own = next;
            light = t->light && !own->numbers;
            for (int c = 0; c < 3; c++)
                t->colors[end][c] = (float)(light ? font_light(own->rgba[c], 0) : own->rgba[c]);
            t->colors[end][3] = (float)own->rgba[3];
        }
        if (t->light && !light)
            t->gl.Disable(GL_FRAMEBUFFER_SRGB);
        if (own->kind != FONT_INK_PLAIN) {
            status = t->ink ? DISPLAY_OK : gl_ink_create(t->function, &t->ink);
            if (status == DISPLAY_OK)
                status = gl_ink_use(t->ink, own, x_px, y_px, t->height_px, light);
        }
        if (status == DISPLAY_OK)
            quads_draw_in_order(t, first, end);
        if (t->ink)
            gl_ink_leave(t->ink);
        if (t->light && !light)
            t->gl.Enable(GL_FRAMEBUFFER_SRGB);
    }
    return status;
}

/* Glyphs that are outlines. */
static enum display_status outlines_draw(struct gl_type *t, const struct font_layout *layout,
                                         const struct font_map *map, double x_px, double y_px,
                                         const double ink[3])
{
    enum display_status status = DISPLAY_OK;
    bool emptied = false; /* the atlas was emptied, and nothing has been requested since */
    int first = 0;
    t->gl.Color3f(mixed(t, ink[0]), mixed(t, ink[1]), mixed(t, ink[2]));
    while (status == DISPLAY_OK && first < layout->glyphs_count) {
        int count = 0;
        enum font_status placed = font_atlas_layout(t->atlas, layout, map, x_px, y_px, t->quads,
                                                    QUADS, &first, &count);
        if (placed != FONT_OK && (placed != FONT_FULL || (emptied && !count))) {
            status = fail_font(placed);
            break;
        }
        status = textures_update(t);
        if (status == DISPLAY_OK && layout->inks_count)
            status = inked_draw(t, layout, ink, x_px, y_px, count);
        else if (status == DISPLAY_OK)
            quads_draw(t, count);
        emptied = placed == FONT_FULL;
        if (emptied) /* glyphs that have been drawn may be dropped */
            font_atlas_begin(t->atlas);
    }
    return status;
}

/* A picture's pixels as a texture of their own, for as long as it takes to draw them. */
static enum display_status tile_draw(const struct gl_type *t, const struct font_tile *tile)
{
    const struct gl *gl = &t->gl;
    const float x0 = (float)tile->left_px, y0 = (float)tile->top_px;
    const float x1 = x0 + (float)tile->width_px, y1 = y0 + (float)tile->height_px;
    GLuint texture;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    /* Light is mixed where the framebuffer is encoded: its numbers are decoded, too. */
    gl->TexImage2D(GL_TEXTURE_2D, 0, t->light ? GL_SRGB8_ALPHA8 : GL_RGBA8, tile->width_px,
                   tile->height_px, 0, GL_RGBA, GL_UNSIGNED_BYTE, tile->rgba);
    bool good = gl->GetError() == GL_NO_ERROR;
    gl->Color4f(1, 1, 1, 1);
    gl->Begin(GL_QUADS);
    corner(t, x0, y0, 0, 0);
    corner(t, x1, y0, 1, 0);
    corner(t, x1, y1, 1, 1);
    corner(t, x0, y1, 0, 1);
    gl->End();
    gl->DeleteTextures(1, &texture);
    return good ? DISPLAY_OK
                : display_fail(DISPLAY_NO_MEMORY,
                               "the display has no memory for a picture of %dx%d pixels",
                               tile->width_px, tile->height_px);
}

static enum display_status picture_draw(struct gl_type *t, const struct font_layout *layout,
                                        int i, const struct font_map *map, double x_px,
                                        double y_px, const double ink[3])
{
    struct font_painter_def def = font_painter_def_default();
    struct font_tile tile;
    if (!t->painter && font_painter_create(&def, &t->painter) != FONT_OK)
        return fail_font(FONT_NO_MEMORY);
    enum font_status made = font_painter_tile(t->painter, layout, i, map, x_px, y_px, ink,
                                              t->width_px, t->height_px, &tile);
    if (made != FONT_OK)
        return fail_font(made);
    enum display_status status = tile.width_px ? tile_draw(t, &tile) : DISPLAY_OK;
    free(tile.rgba);
    return status;
}

/* Outlines as far as the next picture, that picture, and so on. */
static enum display_status coloured_draw(struct gl_type *t, const struct font_layout *layout,
                                         const struct font_map *map, double x_px, double y_px,
                                         const double ink[3])
{
    enum display_status status = DISPLAY_OK;
    for (int i = 0; i < layout->glyphs_count && status == DISPLAY_OK;) {
        struct font_layout part = *layout;
        int end = i;
        while (end < layout->glyphs_count && !font_painter_is_picture(&layout->glyphs[end]))
            end++;
        part.glyphs += i;
        part.glyphs_count = end - i;
        status = outlines_draw(t, &part, map, x_px, y_px, ink);
        if (status == DISPLAY_OK && end < layout->glyphs_count)
            status = picture_draw(t, layout, end++, map, x_px, y_px, ink);
        i = end;
    }
    return status;
}

enum display_status gl_type_draw(struct gl_type *t, const struct font_layout *layout,
                                 const struct font_map *map, double x_px, double y_px,
                                 const double ink[3])
{
    struct font_layout spread;
    enum display_status status;
    bool plain = true;
    for (int i = 0; i < layout->glyphs_count && plain; i++)
        plain =
            font_colour_of(layout->glyphs[i].face, layout->glyphs[i].glyph) == FONT_COLOUR_NONE;
    state_set(t);
    if (plain) {
        status = outlines_draw(t, layout, map, x_px, y_px, ink);
    } else if (font_colour_spread(layout, &spread) == FONT_OK) {
        status = coloured_draw(t, &spread, map, x_px, y_px, ink);
        font_layout_finish(&spread);
    } else {
        status = fail_font(FONT_NO_MEMORY);
    }
    state_reset(t);
    return status;
}

/* ---- glyphs one by one ---- */

static struct font_quad quad_of(const struct gl_type *t, const struct font_atlas_slot *slot)
{
    const float width = (float)t->def.width_px, height = (float)t->def.height_px;
    return (struct font_quad){.x0 = (float)slot->left_px,
                              .y0 = (float)slot->top_px,
                              .x1 = (float)(slot->left_px + slot->width_px),
                              .y1 = (float)(slot->top_px + slot->height_px),
                              .u0 = (float)slot->x / width,
                              .v0 = (float)slot->y / height,
                              .u1 = (float)(slot->x + slot->width_px) / width,
                              .v1 = (float)(slot->y + slot->height_px) / height,
                              .page = slot->page};
}

/* Requests glyphs from *first on, as many as the atlas has room for. On FONT_FULL the caller
 * draws them, empties the atlas, and goes on. */
static enum font_status glyphs_place(struct gl_type *t, const struct gl_type_glyph *glyphs,
                                     int glyphs_count, int *first, int *count, int *left_out)
{
    for (; *first < glyphs_count && *count < QUADS; ++*first) {
        const struct gl_type_glyph *g = &glyphs[*first];
        struct font_atlas_slot slot;
        enum font_status status = font_atlas_get(t->atlas, g->face, g->glyph, g->size_px,
                                                 &g->map, g->x_px, g->y_px, &slot);
        if ((status == FONT_BAD_ARGUMENT && g->map.kind != FONT_AFFINE) ||
            status == FONT_TOO_LARGE) {
            ++*left_out;
            continue;
        }
        if (status != FONT_OK)
            return status;
        if (!slot.width_px)
            continue;
        for (int i = 0; i < 3; i++)
            t->colors[*count][i] = mixed(t, g->color[i]);
        t->colors[*count][3] = g->color[3];
        t->quads[(*count)++] = quad_of(t, &slot);
    }
    return FONT_OK;
}

enum display_status gl_type_glyphs(struct gl_type *t, const struct gl_type_glyph *glyphs,
                                   int glyphs_count, int *left_out)
{
    enum display_status status = DISPLAY_OK;
    bool emptied = false;
    int first = 0;
    *left_out = 0;
    state_set(t);
    while (status == DISPLAY_OK && first < glyphs_count) {
        int count = 0;
        enum font_status placed =
            glyphs_place(t, glyphs, glyphs_count, &first, &count, left_out);
        if (placed != FONT_OK && (placed != FONT_FULL || (emptied && !count))) {
            status = fail_font(placed);
            break;
        }
        status = textures_update(t);
        if (status == DISPLAY_OK)
            quads_draw_in_order(t, 0, count);
        emptied = placed == FONT_FULL;
        if (emptied)
            font_atlas_begin(t->atlas);
    }
    state_reset(t);
    return status;
}
