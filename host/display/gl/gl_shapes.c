/* gl_shapes.c - see gl_shapes.h. */
#include "gl_shapes.h"
#include "display_internal.h"
#include "gl_light.h"
#include "gl_program.h"

#include <srgb.h>

#include <stdlib.h>

#define GL_FUNCTIONS(X)                                                                        \
    X(void, Begin, (GLenum))                                                                   \
    X(void, BindTexture, (GLenum, GLuint))                                                     \
    X(void, BlendFuncSeparate, (GLenum, GLenum, GLenum, GLenum))                               \
    X(void, Clear, (GLbitfield))                                                               \
    X(void, ClearColor, (GLfloat, GLfloat, GLfloat, GLfloat))                                  \
    X(void, Color4f, (GLfloat, GLfloat, GLfloat, GLfloat))                                     \
    X(void, DeleteProgram, (GLuint))                                                           \
    X(void, DeleteTextures, (GLsizei, const GLuint *))                                         \
    X(void, Disable, (GLenum))                                                                 \
    X(void, Enable, (GLenum))                                                                  \
    X(void, End, (void))                                                                       \
    X(void, GenTextures, (GLsizei, GLuint *))                                                  \
    X(void, MultiTexCoord2f, (GLenum, GLfloat, GLfloat))                                       \
    X(void, MultiTexCoord4f, (GLenum, GLfloat, GLfloat, GLfloat, GLfloat))                     \
    X(void, PixelStorei, (GLenum, GLint))                                                      \
    X(void, TexCoord2f, (GLfloat, GLfloat))                                                    \
    X(void, TexImage2D,                                                                        \
      (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void *))           \
    X(void, TexParameteri, (GLenum, GLenum, GLint))                                            \
    X(void, UseProgram, (GLuint))                                                              \
    X(void, Vertex2f, (GLfloat, GLfloat))                                                      \
    X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))

#include "gl_functions.h"

struct gl_shapes {
    struct gl gl;
    void (*(*function)(const char *name))(void);
    GLuint program, texture;
    int width_px, height_px;
    bool light;
};

static const char vertex_text[] = "#version 120\n"
                                  "varying vec4 place;\n"
                                  "varying vec2 form;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    place = gl_MultiTexCoord0;\n"
                                  "    form = gl_MultiTexCoord1.xy;\n"
                                  "    gl_FrontColor = gl_Color;\n"
                                  "    gl_Position = gl_Vertex;\n"
                                  "}\n";

/* Depth is the distance to the edge, positive inside. A pixel covers depths of half a pixel
 * to both sides; the bar covers depths from 0 to its thickness. */
static const char fragment_text[] =
    "#version 120\n"
    "varying vec4 place;\n"
    "varying vec2 form;\n"
    "void main()\n"
    "{\n"
    "    vec2 q = abs(place.xy) - place.zw + form.x;\n"
    "    float depth = form.x - length(max(q, 0.0)) - min(max(q.x, q.y), 0.0);\n"
    "    float thick = 2.0 * min(place.z, place.w);\n"
    "    if (form.y > 0.0) {\n"
    "        depth = 0.5 * form.y - abs(depth);\n"
    "        thick = form.y;\n"
    "    }\n"
    "    float cover = min(depth + 0.5, thick) - max(depth - 0.5, 0.0);\n"
    "    gl_FragColor = vec4(gl_Color.rgb, gl_Color.a * clamp(cover, 0.0, 1.0));\n"
    "}\n";

enum display_status gl_shapes_create(void (*(*function)(const char *name))(void),
                                     struct gl_shapes **out)
{
    *out = NULL;
    struct gl_shapes *s = calloc(1, sizeof *s);
    if (!s)
        return display_fail(DISPLAY_NO_MEMORY, "no memory to draw shapes");
    s->function = function;
    if (!gl_functions_find(&s->gl, function) ||
        !(s->program = gl_program_make(function, vertex_text, fragment_text))) {
        gl_shapes_destroy(s);
        return display_fail(DISPLAY_NO_WINDOW,
                            "no shapes: this display has no OpenGL 2.1 with shaders");
    }
    *out = s;
    return DISPLAY_OK;
}

void gl_shapes_destroy(struct gl_shapes *s)
{
    if (!s)
        return;
    if (s->program)
        s->gl.DeleteProgram(s->program);
    if (s->texture)
        s->gl.DeleteTextures(1, &s->texture);
    free(s);
}

void gl_shapes_begin(struct gl_shapes *s, int width_px, int height_px)
{
    s->width_px = width_px;
    s->height_px = height_px;
    s->light = gl_light_mixed(s->function);
    s->gl.Viewport(0, 0, width_px, height_px);
}

/* Converts a colour's component to the numbers that the framebuffer mixes: linear light, if
 * it mixes light. */
static float mixed(const struct gl_shapes *s, float number)
{
    return s->light ? (float)srgb_light(number) : number;
}

void gl_shapes_clear(struct gl_shapes *s, const float color[4])
{
    /* as numbers, unchanged without GL_FRAMEBUFFER_SRGB */
    s->gl.ClearColor(color[0], color[1], color[2], color[3]);
    s->gl.Clear(GL_COLOR_BUFFER_BIT);
}

static void bar_draw(const struct gl_shapes *s, const struct gl_bar *b)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const struct gl *gl = &s->gl;
    float margin = 1 + b->ring_px / 2;
    gl->Color4f(mixed(s, b->color[0]), mixed(s, b->color[1]), mixed(s, b->color[2]),
                b->color[3]);
    gl->MultiTexCoord2f(GL_TEXTURE1, b->radius_px, b->ring_px);
    for (int i = 0; i < 4; i++) {
        float along = corners[i][0] * (b->half_length_px + margin);
        float across = corners[i][1] * (b->half_width_px + margin);
        float x = b->x_px + along * b->ux - across * b->uy;
        float y = b->y_px + along * b->uy + across * b->ux;
        gl->MultiTexCoord4f(GL_TEXTURE0, along, across, b->half_length_px, b->half_width_px);
        gl->Vertex2f(2 * x / (float)s->width_px - 1, 1 - 2 * y / (float)s->height_px);
    }
}

void gl_shapes_bars(struct gl_shapes *s, const struct gl_bar *bars, int count)
{
    const struct gl *gl = &s->gl;
    gl->UseProgram(s->program);
    gl->Enable(GL_BLEND);
    gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (s->light)
        gl->Enable(GL_FRAMEBUFFER_SRGB);
    gl->Begin(GL_QUADS);
    for (int i = 0; i < count; i++)
        bar_draw(s, &bars[i]);
    gl->End();
    if (s->light)
        gl->Disable(GL_FRAMEBUFFER_SRGB);
    gl->Disable(GL_BLEND);
    gl->UseProgram(0);
}

/* The framebuffer takes the image's numbers as they are: nothing is mixed. */
void gl_shapes_image(struct gl_shapes *s, const struct gl_image *image)
{
    static const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const struct gl *gl = &s->gl;
    if (!s->texture)
        gl->GenTextures(1, &s->texture);
    gl->UseProgram(0);
    gl->Enable(GL_TEXTURE_2D);
    gl->BindTexture(GL_TEXTURE_2D, s->texture);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, image->width, image->height, 0, GL_RGB,
                   GL_UNSIGNED_BYTE, image->rgb);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->Color4f(1, 1, 1, 1);
    gl->Begin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        float x = corners[i][0] > 0 ? image->x1_px : image->x0_px,
              y = corners[i][1] > 0 ? image->y1_px : image->y0_px;
        gl->TexCoord2f(corners[i][0], corners[i][1]);
        gl->Vertex2f(2 * x / (float)s->width_px - 1, 1 - 2 * y / (float)s->height_px);
    }
    gl->End();
    gl->BindTexture(GL_TEXTURE_2D, 0);
    gl->Disable(GL_TEXTURE_2D);
}
