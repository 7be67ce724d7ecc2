/* desk_gl.c - the canvas in OpenGL 3.2, core profile, or OpenGL ES 3, which GTK prefers from
 * 4.14 on: the sheet as one texture, type that is being set as another one over it, ghosts and
 * the cursor as capsules. It draws into whatever framebuffer is bound, in its viewport.
 *
 * Sheet. One triangle covers the canvas; each pixel asks where on the sheet it is (the inverse
 * of studio_view_to_canvas()). Where a pixel covers more than a fiber, it takes the mean of
 * several places, so nothing flickers and no seam can be. */
#include "desk.h"

#include <epoxy/gl.h>
#include <math.h>

#define DASH_PX 6.0
#define FAR_PX 1e6
#define SEEN_MOST 2e6 /* pixels of a line: longer than any on a sheet at the largest zoom */

struct corner {
    float x, y, a_x, a_y, b_x, b_y, radius, hollow, color[4];
};

/* How the sheet is seen. Where this is another one, all of the canvas is drawn. */
struct sheet_seen {
    struct studio_view view;
    int scale, width, height; /* the picture's size */
    bool masked;
};

struct desk_gl {
    GLuint sheet, masked, pieces, array, buffer, picture, mask;
    int width, height; /* of the picture */
    struct studio_shown shown;
    GArray *corners;
    /* what the canvas has, and what has to be drawn of it */
    struct sheet_seen seen;
    struct studio_rectangle changed;     /* of the picture, fibers */
    struct studio_rectangle over, under; /* of the capsules of now and of before, pixels */
};

static const char sheet_vertex[] =
    "void main()\n"
    "{\n"
    "    vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    gl_Position = vec4(at, 0.0, 1.0);\n"
    "}\n";
static const char sheet_fragment[] =
    "uniform sampler2D picture, mask;\n"
    "uniform mat2 turned;\n"         /* pixels to fibers */
    "uniform vec2 middle, origin;\n" /* the same place in pixels and in fibers */
    "uniform vec2 size;\n"           /* of the sheet, fibers */
    "uniform vec4 masked;\n"         /* corner and size of the mask */
    "uniform vec3 desk, ink;\n"
    "uniform float fibers;\n" /* fibers that a pixel is wide */
    "uniform float height;\n"
    "out vec4 color;\n"
    "vec3 at(vec2 place)\n"
    "{\n"
    "    vec3 paper = texture(picture, place / size).rgb;\n"
    "#ifdef MASKED\n"
    "    vec2 on = (place - masked.xy) / max(masked.zw, vec2(1.0));\n"
    "    if (all(greaterThan(on, vec2(0.0))) && all(lessThan(on, "
    "vec2(1.0))))\n"
    "        paper = mix(paper, ink, 0.75 * texture(mask, on).r);\n"
    "#endif\n"
    "    return paper;\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec2 pixel = vec2(gl_FragCoord.x, height - gl_FragCoord.y);\n"
    "    int n = int(clamp(ceil(fibers), 1.0, 8.0));\n"
    "    vec3 sum = vec3(0.0);\n"
    "    for (int j = 0; j < n; j++)\n"
    "        for (int i = 0; i < n; i++) {\n"
    "            vec2 part = (vec2(float(i), float(j)) + 0.5) / float(n) - 0.5;\n"
    "            sum += at(origin + turned * (pixel + part - middle));\n"
    "        }\n"
    "    vec2 place = origin + turned * (pixel - middle);\n"
    "    vec2 inside = clamp(0.5 + min(place, size - place) / max(fibers, 1e-6), 0.0, 1.0);\n"
    "    color = vec4(mix(desk, sum / float(n * n), inside.x * inside.y), 1.0);\n"
    "}\n";
static const char piece_vertex[] = "in vec2 place;\n"
                                   "in vec4 ends;\n"
                                   "in vec2 shape;\n"
                                   "in vec4 tint;\n"
                                   "uniform vec2 size;\n"
                                   "out vec2 at;\n"
                                   "out vec4 between;\n"
                                   "out vec2 form;\n"
                                   "out vec4 paint;\n"
                                   "void main()\n"
                                   "{\n"
                                   "    at = place;\n"
                                   "    between = ends;\n"
                                   "    form = shape;\n"
                                   "    paint = tint;\n"
                                   "    gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - "
                                   "2.0 * place.y / size.y, 0.0, 1.0);\n"
                                   "}\n";
static const char piece_fragment[] =
    "in vec2 at;\n"
    "in vec4 between;\n"
    "in vec2 form;\n"
    "in vec4 paint;\n"
    "out vec4 color;\n"
    "void main()\n"
    "{\n"
    "    vec2 way = between.zw - between.xy, from = at - between.xy;\n"
    "    float part = clamp(dot(from, way) / max(dot(way, way), 1e-6), 0.0, 1.0);\n"
    "    float away = length(from - part * way);\n"
    "    float cover = form.y > 0.0 ? clamp(form.y + 0.5 - abs(away - form.x), 0.0, 1.0)\n"
    "                               : clamp(form.x + 0.5 - away, 0.0, 1.0);\n"
    "    color = vec4(mix(vec3(1.0), paint.rgb, form.y > 0.0 ? 1.0 : cover), cover * "
    "paint.a);\n"
    "}\n";

/* ---- programs ---- */

static GLuint shader_make(GLenum kind, const char *defined, const char *text, char **why)
{
    const char *const whole[] = {epoxy_is_desktop_gl() ? "#version 150\n"
                                                       : "#version 300 es\n"
                                                         "precision highp float;\n"
                                                         "precision highp int;\n",
                                 defined, text};
    char log[500] = "";
    GLint good = 0;
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 3, whole, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        g_free(*why);
        *why = g_strdup_printf("OpenGL: %s", log);
    }
    return shader;
}

static GLuint program_make(const char *defined, const char *vertex, const char *fragment,
                           char **why)
{
    GLint good = 0;
    GLuint program = glCreateProgram(),
           parts[] = {shader_make(GL_VERTEX_SHADER, defined, vertex, why),
                      shader_make(GL_FRAGMENT_SHADER, defined, fragment, why)};
    for (int i = 0; i < 2; i++)
        glAttachShader(program, parts[i]);
    glBindAttribLocation(program, 0, "place");
    glBindAttribLocation(program, 1, "ends");
    glBindAttribLocation(program, 2, "shape");
    glBindAttribLocation(program, 3, "tint");
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    for (int i = 0; i < 2; i++)
        glDeleteShader(parts[i]);
    if (!good && !*why)
        *why = g_strdup("OpenGL: a program cannot be linked");
    return program;
}

static GLuint texture_make(void)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

struct desk_gl *desk_gl_create(char **why)
{
    static const struct {
        GLint size;
        size_t at;
    } parts[] = {{2, offsetof(struct corner, x)},
                 {4, offsetof(struct corner, a_x)},
                 {2, offsetof(struct corner, radius)},
                 {4, offsetof(struct corner, color)}};
    struct desk_gl *gl = g_new0(struct desk_gl, 1);
    gl->masked = program_make("#define MASKED\n", sheet_vertex, sheet_fragment, why);
    gl->sheet = program_make("", sheet_vertex, sheet_fragment, why);
    gl->pieces = program_make("", piece_vertex, piece_fragment, why);
    gl->picture = texture_make();
    gl->mask = texture_make();
    gl->corners = g_array_new(FALSE, FALSE, sizeof(struct corner));
    glGenVertexArrays(1, &gl->array);
    glBindVertexArray(gl->array);
    glGenBuffers(1, &gl->buffer);
    glBindBuffer(GL_ARRAY_BUFFER, gl->buffer);
    for (GLuint i = 0; i < G_N_ELEMENTS(parts); i++) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, parts[i].size, GL_FLOAT, GL_FALSE, sizeof(struct corner),
                              (const void *)parts[i].at);
    }
    if (!*why)
        return gl;
    desk_gl_destroy(gl);
    return NULL;
}

void desk_gl_destroy(struct desk_gl *gl)
{
    if (!gl)
        return;
    glDeleteProgram(gl->sheet);
    glDeleteProgram(gl->masked);
    glDeleteProgram(gl->pieces);
    glDeleteTextures(1, &gl->picture);
    glDeleteTextures(1, &gl->mask);
    glDeleteBuffers(1, &gl->buffer);
    glDeleteVertexArrays(1, &gl->array);
    g_array_free(gl->corners, TRUE);
    g_free(gl);
}

/* ---- textures ---- */

bool desk_gl_picture(struct desk_gl *gl, const struct studio_picture *picture)
{
    GLint most = 0;
    struct studio_rectangle r = picture->changed;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (picture->width > most || picture->height > most)
        return false;
    glBindTexture(GL_TEXTURE_2D, gl->picture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (gl->width != picture->width || gl->height != picture->height) {
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture->width, picture->height, 0, GL_RGBA,
                     GL_UNSIGNED_BYTE, NULL);
        r = (struct studio_rectangle){0, 0, picture->width, picture->height};
        gl->width = picture->width;
        gl->height = picture->height;
    }
    if (r.right <= r.left)
        return true;
    gl->changed = studio_rectangle_join(gl->changed, r);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, picture->width);
    glTexSubImage2D(GL_TEXTURE_2D, 0, r.left, r.top, r.right - r.left, r.bottom - r.top,
                    GL_RGBA, GL_UNSIGNED_BYTE,
                    picture->pixels + STUDIO_PIXEL * ((size_t)r.top * (size_t)picture->width +
                                                      (size_t)r.left));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    return true;
}

void desk_gl_shown(struct desk_gl *gl, const struct studio_shown *shown)
{
    gl->shown = *shown;
    if (!shown->gray)
        return;
    glBindTexture(GL_TEXTURE_2D, gl->mask);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, shown->width, shown->height, 0, GL_RED,
                 GL_UNSIGNED_BYTE, shown->gray);
}

/* ---- capsules ---- */

struct look {
    float color[4];
    double hollow; /* half the width of the line around it; 0: filled */
};

/* The pixels that it touches; far away, any place that is. */
static struct studio_rectangle pixels_of(double left, double top, double right, double bottom)
{
    return (struct studio_rectangle){(int)floor(fmax(-FAR_PX, fmin(FAR_PX, left))),
                                     (int)floor(fmax(-FAR_PX, fmin(FAR_PX, top))),
                                     (int)ceil(fmax(-FAR_PX, fmin(FAR_PX, right))),
                                     (int)ceil(fmax(-FAR_PX, fmin(FAR_PX, bottom)))};
}

static void piece_add(struct desk_gl *gl, struct studio_place a, struct studio_place b,
                      double radius, const struct look *look)
{
    const double reach = radius + look->hollow + 1.5, left = fmin(a.x, b.x) - reach,
                 right = fmax(a.x, b.x) + reach, top = fmin(a.y, b.y) - reach,
                 bottom = fmax(a.y, b.y) + reach;
    const double corners[6][2] = {{left, top}, {right, top},    {right, bottom},
                                  {left, top}, {right, bottom}, {left, bottom}};
    for (int i = 0; i < 6; i++) {
        struct corner c = {(float)corners[i][0], (float)corners[i][1], (float)a.x,
                           (float)a.y,           (float)b.x,           (float)b.y,
                           (float)radius,        (float)look->hollow,  {0}};
        memcpy(c.color, look->color, sizeof c.color);
        g_array_append_val(gl->corners, c);
    }
    gl->over = studio_rectangle_join(gl->over, pixels_of(left, top, right, bottom));
}

/* Those from the one to the other. */
static void pieces_draw(struct desk_gl *gl, guint from, guint to, int width, int height)
{
    if (from == to)
        return;
    glUseProgram(gl->pieces);
    glUniform2f(glGetUniformLocation(gl->pieces, "size"), (float)width, (float)height);
    glBindVertexArray(gl->array);
    glBindBuffer(GL_ARRAY_BUFFER, gl->buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((to - from) * sizeof(struct corner)),
                 &g_array_index(gl->corners, struct corner, from), GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)(to - from));
}

static struct studio_place pixel_of(const struct desk *d, int scale, double x, double y)
{
    struct studio_place place = studio_view_to_canvas(&d->view, x, y);
    place.x *= scale;
    place.y *= scale;
    return place;
}

/* The way that the paper has not done yet: it darkens, and where it crosses itself it darkens
 * once. */
static void ghost_add(struct desk_gl *gl, const struct desk *d, int scale)
{
    for (guint i = 0; i < d->ghost->len; i++) {
        const struct desk_ghost *g = &g_array_index(d->ghost, struct desk_ghost, i);
        const struct desk_ghost *before = i && !g->begins ? g - 1 : g;
        struct look look = {{0, 0, 0, 1}, 0};
        for (int k = 0; k < 3; k++)
            look.color[k] = (float)(0.5 + 0.5 * g->rgb[k]);
        piece_add(gl, pixel_of(d, scale, before->x, before->y), pixel_of(d, scale, g->x, g->y),
                  scale * d->view.zoom * g->radius, &look);
    }
}

static void ghost_draw(struct desk_gl *gl, guint count, int width, int height)
{
    glBlendEquation(GL_MIN);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE); /* the canvas is opaque everywhere */
    pieces_draw(gl, 0, count, width, height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBlendEquation(GL_FUNC_ADD);
}

/* From where the hand came down to where it is: a wash's rectangle, a throw's direction. */
static void drag_add(struct desk_gl *gl, const struct desk *d, int scale,
                     const struct look *look)
{
    const enum studio_tool_number tool = desk_tool(d);
    const struct studio_place to = studio_view_to_sheet(&d->view, d->pointer_x, d->pointer_y);
    const double x[] = {d->down_x, to.x, to.x, d->down_x, d->down_x},
                 y[] = {d->down_y, d->down_y, to.y, to.y, d->down_y};
    const enum studio_outline outline = (enum studio_outline)d->settings.value[STUDIO_OUTLINE];
    double points[2 * STUDIO_OUTLINE_CORNERS];
    if (!d->down)
        return;
    for (int i = 0; i < 48 && d->shaping; i++) {
        const struct studio_place a = desk_shape_at(d, to, i / 48.0),
                                  b = desk_shape_at(d, to, (i + 1) / 48.0);
        piece_add(gl, pixel_of(d, scale, a.x, a.y), pixel_of(d, scale, b.x, b.y), 0, look);
    }
    if (tool == STUDIO_TOOL_SPLATTER)
        piece_add(gl, pixel_of(d, scale, x[0], y[0]), pixel_of(d, scale, to.x, to.y), scale,
                  look);
    for (int i = 0; i < 4 && tool == STUDIO_TOOL_WASH; i++)
        piece_add(gl, pixel_of(d, scale, x[i], y[i]), pixel_of(d, scale, x[i + 1], y[i + 1]), 0,
                  look);
    if (tool != STUDIO_TOOL_SELECT || outline == STUDIO_OUTLINE_LASSO)
        return;
    const int count = studio_outline_points(outline, x[0], y[0], to.x, to.y, points);
    for (int i = 0; i < count; i++) {
        const double *a = points + 2 * i, *b = points + 2 * ((i + 1) % count);
        piece_add(gl, pixel_of(d, scale, a[0], a[1]), pixel_of(d, scale, b[0], b[1]), 0, look);
    }
}

/* What is selected has a line around it, of dark and light dashes. A dash that begins on one
 * side ends on the next. */
static void outline_add(struct desk_gl *gl, const struct desk *d, int scale)
{
    static const struct look looks[2] = {{{0, 0, 0, 0.9f}, 0}, {{1, 1, 1, 0.9f}, 0}};
    const double dash = DASH_PX * scale, width = scale * d->view.width,
                 height = scale * d->view.height;
    double gone = 0; /* pixels along the outline */
    for (int i = 0, loop = 0, begin = 0; i < d->outline.count; i++) {
        while (loop + 1 < d->outline.loops && i >= d->outline.ends[loop])
            begin = d->outline.ends[loop++];
        const int next = i + 1 < d->outline.ends[loop] ? i + 1 : begin;
        const double *p = d->outline.points + 2 * i, *q = d->outline.points + 2 * next;
        const struct studio_place a = pixel_of(d, scale, p[0], p[1]),
                                  b = pixel_of(d, scale, q[0], q[1]);
        const double length = hypot(b.x - a.x, b.y - a.y);
        for (double at = 0; at < length && length < SEEN_MOST;) {
            const double end = fmin(length, at + dash - fmod(gone + at, dash)),
                         from = at / length, to = end / length;
            const struct studio_place first = {a.x + from * (b.x - a.x),
                                               a.y + from * (b.y - a.y)},
                                      last = {a.x + to * (b.x - a.x), a.y + to * (b.y - a.y)};
            const int light = (int)fmod((gone + at + 0.01) / dash, 2);
            if (first.x > -dash && first.y > -dash && first.x < width + dash &&
                first.y < height + dash)
                piece_add(gl, first, last, 0.6 * scale, &looks[light]);
            at = fmax(end, at + 0.01);
        }
        gone = fmod(gone + length, 2 * dash);
    }
}

static void cursor_add(struct desk_gl *gl, const struct desk *d, int scale)
{
    const struct look dark = {{0.05f, 0.05f, 0.05f, 0.9f}, 0.6 * scale},
                      light = {{1, 1, 1, 0.8f}, 1.6 * scale};
    const double x = scale * d->pointer_x, y = scale * d->pointer_y, arm = 5.0 * scale,
                 radius = scale * d->view.zoom * desk_cursor_radius(d);
    const struct studio_place at = {x, y};
    const struct look *looks[] = {&light, &dark};
    for (int i = 0; i < 2; i++) {
        drag_add(gl, d, scale, looks[i]);
        if (!d->pointer_inside || d->panning)
            continue;
        if (radius > arm)
            piece_add(gl, at, at, radius, looks[i]);
        piece_add(gl, (struct studio_place){x - arm, y}, (struct studio_place){x + arm, y}, 0,
                  looks[i]);
        piece_add(gl, (struct studio_place){x, y - arm}, (struct studio_place){x, y + arm}, 0,
                  looks[i]);
    }
}

/* ---- all of it ---- */

static GLuint sheet_program(const struct desk_gl *gl, const struct studio_view *v, int scale,
                            bool mask)
{
    const double pixel = 1 / (v->zoom * scale), c = pixel * cos(v->turn),
                 s = pixel * sin(v->turn), side = v->mirrored ? -1 : 1;
    const GLfloat turned[] = {(float)(side * c), (float)-s, (float)(side * s), (float)c};
    const GLuint p =
        mask ? gl->masked : gl->sheet; /* two look-ups a place cost twice as much */
    glUseProgram(p);
    glUniform1i(glGetUniformLocation(p, "picture"), 0);
    glUniform1i(glGetUniformLocation(p, "mask"), 1);
    glUniformMatrix2fv(glGetUniformLocation(p, "turned"), 1, GL_FALSE, turned);
    glUniform2f(glGetUniformLocation(p, "middle"), (float)(scale * v->width / 2),
                (float)(scale * v->height / 2));
    glUniform2f(glGetUniformLocation(p, "origin"), (float)v->x0, (float)v->y0);
    glUniform2f(glGetUniformLocation(p, "size"), (float)gl->width, (float)gl->height);
    glUniform3f(glGetUniformLocation(p, "desk"), 0.30f, 0.29f, 0.28f);
    glUniform1f(glGetUniformLocation(p, "fibers"), (float)pixel);
    glUniform1f(glGetUniformLocation(p, "height"), (float)lrint(scale * v->height));
    return p;
}

static void sheet_triangle(const struct desk_gl *gl)
{
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, gl->mask);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, gl->picture);
    glBindVertexArray(gl->array);
    glDisable(GL_BLEND);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* Whether something is shown on the sheet as it would be. */
static bool masked(const struct desk_gl *gl, const struct desk *d)
{
    return gl->shown.gray != NULL && (!desk_stamps(d) || d->pointer_inside);
}

static void sheet_draw(const struct desk_gl *gl, const struct desk *d, int scale,
                       const double ink[3])
{
    const bool stamps = desk_stamps(d), mask = masked(gl, d);
    const struct studio_place at = studio_view_to_sheet(&d->view, d->pointer_x, d->pointer_y);
    const double on_x =
                     gl->shown.x + (stamps ? floor(at.x) : 0), /* a stamp is at the pointer */
        on_y = gl->shown.y + (stamps ? floor(at.y) : 0);
    const GLuint p = sheet_program(gl, &d->view, scale, mask);
    glUniform4f(glGetUniformLocation(p, "masked"), (float)on_x, (float)on_y,
                (float)gl->shown.width, (float)gl->shown.height);
    glUniform3f(glGetUniformLocation(p, "ink"), (float)ink[0], (float)ink[1], (float)ink[2]);
    sheet_triangle(gl);
}

/* The pixels of what has changed of the picture, with those beside them that take a part of
 * it. */
static struct studio_rectangle changed_pixels(const struct desk_gl *gl,
                                              const struct studio_view *view, int scale)
{
    const struct studio_rectangle *r = &gl->changed;
    const double reach = 2 + ceil(scale * view->zoom),
                 x[] = {r->left, r->right, r->right, r->left},
                 y[] = {r->top, r->top, r->bottom, r->bottom};
    struct studio_rectangle pixels = {0};
    for (int i = 0; i < 4 && r->right > r->left; i++) {
        const struct studio_place at = studio_view_to_canvas(view, x[i], y[i]);
        pixels = studio_rectangle_join(pixels,
                                       pixels_of(scale * at.x - reach, scale * at.y - reach,
                                                 scale * at.x + reach, scale * at.y + reach));
    }
    return pixels;
}

static bool view_same(const struct studio_view *a, const struct studio_view *b)
{
    return a->width == b->width && a->height == b->height && a->x0 == b->x0 && a->y0 == b->y0 &&
           a->zoom == b->zoom && a->turn == b->turn && a->mirrored == b->mirrored;
}

/* What has to be drawn, and from here on it alone is. */
static void part_begin(struct desk_gl *gl, const struct sheet_seen *seen, int width, int height,
                       struct studio_rectangle *drawn)
{
    const struct sheet_seen *s = &gl->seen;
    const bool same = s->scale == seen->scale && s->width == seen->width &&
                      s->height == seen->height && !s->masked && !seen->masked &&
                      view_same(&s->view, &seen->view);
    struct studio_rectangle r = *drawn;
    r = studio_rectangle_join(r, changed_pixels(gl, &seen->view, seen->scale));
    r = studio_rectangle_join(r, gl->under);
    r = studio_rectangle_join(r, gl->over);
    if (!same)
        r = (struct studio_rectangle){0, 0, width, height};
    *drawn = (struct studio_rectangle){CLAMP(r.left, 0, width), CLAMP(r.top, 0, height),
                                       CLAMP(r.right, 0, width), CLAMP(r.bottom, 0, height)};
    gl->seen = *seen;
    glEnable(GL_SCISSOR_TEST);
    glScissor(drawn->left, height - drawn->bottom, MAX(0, drawn->right - drawn->left),
              MAX(0, drawn->bottom - drawn->top));
}

static void part_end(struct desk_gl *gl)
{
    glDisable(GL_SCISSOR_TEST);
    gl->changed = (struct studio_rectangle){0};
    gl->under = gl->over;
    gl->over = (struct studio_rectangle){0};
    g_array_set_size(gl->corners, 0);
}

static bool nothing_in(const struct studio_rectangle *drawn)
{
    return drawn && (drawn->right <= drawn->left || drawn->bottom <= drawn->top);
}

static void ground_draw(void)
{
    glClearColor(0.30f, 0.29f, 0.28f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

void desk_gl_sheet(struct desk_gl *gl, const struct studio_view *view, int scale,
                   struct studio_rectangle *drawn)
{
    const struct sheet_seen seen = {*view, scale, gl->width, gl->height, false};
    if (drawn)
        part_begin(gl, &seen, (int)lrint(scale * view->width), (int)lrint(scale * view->height),
                   drawn);
    if (!nothing_in(drawn)) {
        ground_draw();
        if (gl->width) {
            sheet_program(gl, view, scale, false);
            sheet_triangle(gl);
        }
    }
    part_end(gl);
}

void desk_gl_draw(struct desk_gl *gl, const struct desk *d, int scale,
                  struct studio_rectangle *drawn)
{
    const int width = (int)lrint(scale * d->view.width),
              height = (int)lrint(scale * d->view.height);
    const struct sheet_seen seen = {d->view, scale, gl->width, gl->height, masked(gl, d)};
    double ink[3];
    ghost_add(gl, d, scale);
    const guint ghost = gl->corners->len;
    outline_add(gl, d, scale);
    cursor_add(gl, d, scale);
    if (drawn)
        part_begin(gl, &seen, width, height, drawn);
    if (!nothing_in(drawn)) {
        ground_draw();
        if (gl->width) {
            desk_tool_color(d, ink);
            sheet_draw(gl, d, scale, ink);
            glEnable(GL_BLEND);
            glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
            ghost_draw(gl, ghost, width, height);
            pieces_draw(gl, ghost, gl->corners->len, width, height);
            glDisable(GL_BLEND);
        }
    }
    part_end(gl);
}
