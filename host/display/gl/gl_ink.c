/* gl_ink.c - see gl_ink.h. */
#include "gl_ink.h"
#include "display_internal.h"
#include "gl_program.h"

#include <stdlib.h>

#define GL_FUNCTIONS(X)                                                                        \
    X(void, ActiveTexture, (GLenum))                                                           \
    X(void, BindTexture, (GLenum, GLuint))                                                     \
    X(void, DeleteProgram, (GLuint))                                                           \
    X(void, DeleteTextures, (GLsizei, const GLuint *))                                         \
    X(void, GenTextures, (GLsizei, GLuint *))                                                  \
    X(GLenum, GetError, (void))                                                                \
    X(void, GetIntegerv, (GLenum, GLint *))                                                    \
    X(GLint, GetUniformLocation, (GLuint, const char *))                                       \
    X(void, PixelStorei, (GLenum, GLint))                                                      \
    X(void, TexImage2D,                                                                        \
      (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *))           \
    X(void, TexParameteri, (GLenum, GLenum, GLint))                                            \
    X(void, Uniform1fv, (GLint, GLsizei, const GLfloat *))                                     \
    X(void, Uniform1i, (GLint, GLint))                                                         \
    X(void, Uniform2f, (GLint, GLfloat, GLfloat))                                              \
    X(void, Uniform4f, (GLint, GLfloat, GLfloat, GLfloat, GLfloat))                            \
    X(void, Uniform4fv, (GLint, GLsizei, const GLfloat *))                                     \
    X(void, UseProgram, (GLuint))

#include "gl_functions.h"

/* The shader's variables. */
#define UNIFORMS(X) X(cover) X(picture) X(kind) X(light) X(origin) X(way) X(stops) X(at) X(rgba)

struct gl_ink {
    struct gl gl;
    GLuint program, texture;
#define UNIFORM(name) GLint name;
    UNIFORMS(UNIFORM)
};

static const char vertex_text[] = "#version 120\n"
                                  "varying vec2 uv;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    uv = gl_MultiTexCoord0.xy;\n"
                                  "    gl_Position = gl_Vertex;\n"
                                  "}\n";

/* kind: as enum font_ink_kind. way: the gradient's two ends, or its centre and its radius; of a
 * picture its size and its cover. A stop's colour holds from it on, and goes over to the next
 * one's where that lies further on. */
static const char fragment_text[] =
    "#version 120\n"
    "varying vec2 uv;\n"
    "uniform sampler2D cover, picture;\n"
    "uniform int kind, stops;\n"
    "uniform bool light;\n"
    "uniform vec2 origin;\n"
    "uniform vec4 way;\n"
    "uniform float at[8];\n"
    "uniform vec4 rgba[8];\n"
    "vec4 stop_at(float part)\n"
    "{\n"
    "    vec4 here = rgba[0];\n"
    "    for (int i = 0; i < 7; i++)\n"
    "        if (i + 1 < stops && part >= at[i]) {\n"
    "            float span = at[i + 1] - at[i];\n"
    "            float along = span > 0.0 ? clamp((part - at[i]) / span, 0.0, 1.0) : 1.0;\n"
    "            here = mix(rgba[i], rgba[i + 1], along);\n"
    "        }\n"
    "    return here;\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    vec2 place = vec2(gl_FragCoord.x, -gl_FragCoord.y) - origin;\n"
    "    vec4 ink;\n"
    "    if (kind == 1) {\n"
    "        vec2 d = way.zw - way.xy;\n"
    "        float square = dot(d, d);\n"
    "        ink = stop_at(square > 0.0 ? dot(place - way.xy, d) / square : 0.0);\n"
    "    } else if (kind == 2) {\n"
    "        ink = stop_at(way.z > 0.0 ? length(place - way.xy) / way.z : 1.0);\n"
    "    } else {\n"
    "        ink = vec4(texture2D(picture, (floor(place) + 0.5) / way.xy).rgb, way.z);\n"
    "    }\n"
    "    if (light)\n"
    "        ink.rgb = mix(pow((ink.rgb + 0.055) / 1.055, vec3(2.4)), ink.rgb / 12.92,\n"
    "                      vec3(lessThanEqual(ink.rgb, vec3(0.04045))));\n"
    "    gl_FragColor = vec4(ink.rgb, ink.a * texture2D(cover, uv).a);\n"
    "}\n";

enum display_status gl_ink_create(void (*(*function)(const char *name))(void),
                                  struct gl_ink **out)
{
    *out = NULL;
    struct gl_ink *s = calloc(1, sizeof *s);
    if (!s)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for ink on a display");
    if (!gl_functions_find(&s->gl, function) ||
        !(s->program = gl_program_make(function, vertex_text, fragment_text))) {
        gl_ink_destroy(s);
        return display_fail(DISPLAY_NO_WINDOW, "no gradients and pictures as ink: this display "
                                               "has no OpenGL 2.1 with shaders");
    }
#define LOCATION(name) s->name = s->gl.GetUniformLocation(s->program, #name);
    UNIFORMS(LOCATION)
    *out = s;
    return DISPLAY_OK;
}

void gl_ink_destroy(struct gl_ink *s)
{
    if (!s)
        return;
    if (s->program)
        s->gl.DeleteProgram(s->program);
    if (s->texture)
        s->gl.DeleteTextures(1, &s->texture);
    free(s);
}

static void gradient_set(const struct gl_ink *s, const struct font_ink *of)
{
    GLfloat at[FONT_INK_STOPS_MAX] = {0}, rgba[4 * FONT_INK_STOPS_MAX] = {0};
    for (int i = 0; i < of->stops_count; i++) {
        at[i] = (GLfloat)of->stops[i].at;
        for (int c = 0; c < 4; c++)
            rgba[4 * i + c] = (GLfloat)of->stops[i].rgba[c];
    }
    s->gl.Uniform1i(s->stops, of->stops_count);
    s->gl.Uniform1fv(s->at, FONT_INK_STOPS_MAX, at);
    s->gl.Uniform4fv(s->rgba, FONT_INK_STOPS_MAX, rgba);
    s->gl.Uniform4f(s->way, (GLfloat)of->x0, (GLfloat)of->y0, (GLfloat)of->x1, (GLfloat)of->y1);
}

/* Binds the picture to unit 1; it may have changed since it was last used. */
static enum display_status picture_set(struct gl_ink *s, const struct font_ink *of)
{
    const struct gl *gl = &s->gl;
    if (!s->texture)
        gl->GenTextures(1, &s->texture);
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D, s->texture);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    uint8_t *rows = NULL; /* without gaps: a pitch need not be so many pixels */
    size_t row = 3 * (size_t)of->width_px;
    if (of->pitch != 3 * of->width_px) {
        rows = malloc(row * (size_t)of->height_px);
        for (int y = 0; rows && y < of->height_px; y++)
            for (size_t k = 0; k < row; k++)
                rows[(size_t)y * row + k] = of->rgb[(ptrdiff_t)y * of->pitch + (ptrdiff_t)k];
    }
    bool room = rows || of->pitch == 3 * of->width_px;
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (room)
        gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, of->width_px, of->height_px, 0, GL_RGB,
                       GL_UNSIGNED_BYTE, rows ? rows : of->rgb);
    bool good = gl->GetError() == GL_NO_ERROR && room;
    free(rows);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->Uniform4f(s->way, (GLfloat)of->width_px, (GLfloat)of->height_px, (GLfloat)of->rgba[3],
                  0);
    return good ? DISPLAY_OK
                : display_fail(DISPLAY_NO_MEMORY,
                               "the display has no memory for a picture of %dx%d pixels",
                               of->width_px, of->height_px);
}

enum display_status gl_ink_use(struct gl_ink *s, const struct font_ink *of, double x_px,
                               double y_px, int height_px, bool light)
{
    const struct gl *gl = &s->gl;
    GLint viewport[4] = {0};
    if (font_ink_check(of) != FONT_OK)
        return display_fail(DISPLAY_BAD_ARGUMENT, "%s", font_error());
    bool picture = of->kind == FONT_INK_PICTURE;
    gl->GetIntegerv(GL_VIEWPORT, viewport);
    gl->UseProgram(s->program);
    gl->Uniform1i(s->cover, 0);
    gl->Uniform1i(s->picture, 1);
    gl->Uniform1i(s->kind, (GLint)of->kind);
    gl->Uniform1i(s->light, light);
    /* Rows go down in the text and up in the framebuffer. A picture's own place is a whole
     * number of its pixels away. */
    double x = viewport[0] + x_px, y = y_px - viewport[1] - height_px;
    gl->Uniform2f(s->origin, (GLfloat)(x + (picture ? of->x0 : 0)),
                  (GLfloat)(y + (picture ? of->y0 : 0)));
    if (picture)
        return picture_set(s, of);
    gradient_set(s, of);
    return DISPLAY_OK;
}

void gl_ink_leave(struct gl_ink *s)
{
    s->gl.UseProgram(0);
}
