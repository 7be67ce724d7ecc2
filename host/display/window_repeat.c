/* window_repeat.c - see window_repeat.h. */
#include "window_repeat.h"

#include <math.h>
#include <stdlib.h>

struct window_repeat {
    struct window *window;
    GLFWwindow *others[SCREENS_MAX];
    int count;
    GLuint texture;
};

static GLFWwindow *other_make(const struct window *window, int screen)
{
    glfw3.DefaultWindowHints();
    glfw3.WindowHint(GLFW_CONTEXT_VERSION_MAJOR, 2);
    glfw3.WindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
    glfw3.WindowHint(GLFW_DEPTH_BITS, 0);
    glfw3.WindowHint(GLFW_STENCIL_BITS, 0);
    glfw3.WindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfw3.WindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfw3.WindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
    GLFWwindow *other = glfw3.CreateWindow(640, 480, "lutetia", NULL, window->glfw);
    if (!other)
        return NULL;
    glfw3.ShowWindow(other);
    screens_fill(other, screen);
    glfw3.MakeContextCurrent(other);
    glfw3.SwapInterval(0); /* one screen waits, for all */
    return other;
}

struct window_repeat *window_repeat_create(struct window *window, const struct screens *screens)
{
    struct window_repeat *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->window = window;
    for (int i = 0; i < screens->same_count; i++) {
        r->others[r->count] = other_make(window, screens->same[i]);
        if (!r->others[r->count++]) {
            glfw3.MakeContextCurrent(window->glfw);
            window_repeat_destroy(r);
            return NULL;
        }
    }
    glfw3.MakeContextCurrent(window->glfw);
    window->gl.GenTextures(1, &r->texture);
    window->gl.BindTexture(GL_TEXTURE_2D, r->texture);
    window->gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    window->gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    window->gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    window->gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return r;
}

void window_repeat_destroy(struct window_repeat *r)
{
    if (!r)
        return;
    if (r->texture)
        r->window->gl.DeleteTextures(1, &r->texture);
    for (int i = 0; i < r->count; i++)
        if (r->others[i])
            glfw3.DestroyWindow(r->others[i]);
    free(r);
}

/* The texture, upright, in the middle of the window whose context is current. */
static void picture_draw(const struct gl *gl, int width, int height, double scale, int from_x,
                         int from_y)
{
    const int shown_x = (int)lround(scale * from_x), shown_y = (int)lround(scale * from_y);
    static const float corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    gl->Viewport(0, 0, width, height);
    gl->ClearColor(0, 0, 0, 1);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    gl->Viewport((width - shown_x) / 2, (height - shown_y) / 2, shown_x, shown_y);
    gl->TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    gl->Enable(GL_TEXTURE_2D);
    gl->Begin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        gl->TexCoord2f(corners[i][0], corners[i][1]);
        gl->Vertex2f(2 * corners[i][0] - 1, 2 * corners[i][1] - 1);
    }
    gl->End();
    gl->Disable(GL_TEXTURE_2D);
}

void window_repeat_show(struct window_repeat *r)
{
    const struct gl *gl = &r->window->gl;
    int from_x, from_y, width, height;
    glfw3.GetFramebufferSize(r->window->glfw, &from_x, &from_y);
    if (from_x < 1 || from_y < 1)
        return;
    gl->BindTexture(GL_TEXTURE_2D, r->texture);
    gl->CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, 0, 0, from_x, from_y, 0);
    gl->Flush(); /* the other contexts see it from then on */
    for (int i = 0; i < r->count; i++) {
        glfw3.MakeContextCurrent(r->others[i]);
        glfw3.GetFramebufferSize(r->others[i], &width, &height);
        if (width < 1 || height < 1)
            continue;
        gl->BindTexture(GL_TEXTURE_2D, r->texture);
        picture_draw(gl, width, height, fmin((double)width / from_x, (double)height / from_y),
                     from_x, from_y);
        glfw3.SwapBuffers(r->others[i]);
    }
    glfw3.MakeContextCurrent(r->window->glfw);
}
