/* studio_pictures.c - see studio_pictures.h. */
#include "studio_pictures.h"

#include <stdlib.h>
#include <string.h>

struct studio_rectangle studio_rectangle_join(struct studio_rectangle a,
                                              struct studio_rectangle b)
{
    if (a.right <= a.left || a.bottom <= a.top)
        return b;
    if (b.right <= b.left || b.bottom <= b.top)
        return a;
    return (struct studio_rectangle){
        a.left < b.left ? a.left : b.left, a.top < b.top ? a.top : b.top,
        a.right > b.right ? a.right : b.right, a.bottom > b.bottom ? a.bottom : b.bottom};
}

bool studio_pictures_begin(struct studio_pictures *p, int width, int height)
{
    const size_t bytes = STUDIO_PIXEL * (size_t)width * (size_t)height;
    const struct studio_rectangle all = {0, 0, width, height};
    *p = (struct studio_pictures){.width = width, .height = height, .newest = 1, .looking = 2};
    pthread_mutex_init(&p->lock, NULL);
    p->canvas = calloc(bytes, 1);
    bool good = p->canvas != NULL;
    for (int i = 0; i < 3; i++) {
        p->places[i] = (struct studio_picture){
            .width = width, .height = height, .pixels = calloc(bytes, 1), .stale = all};
        good = good && p->places[i].pixels;
    }
    if (!good)
        studio_pictures_finish(p);
    return good;
}

void studio_pictures_finish(struct studio_pictures *p)
{
    if (p->width)
        pthread_mutex_destroy(&p->lock);
    free(p->canvas);
    for (int i = 0; i < 3; i++)
        free(p->places[i].pixels);
    *p = (struct studio_pictures){0};
}

static void stale_copy(const struct studio_pictures *p, struct studio_picture *to)
{
    const struct studio_rectangle r = to->stale;
    if (r.right <= r.left)
        return;
    const size_t row = STUDIO_PIXEL * (size_t)p->width,
                 bytes = STUDIO_PIXEL * (size_t)(r.right - r.left);
    for (int y = r.top; y < r.bottom; y++) {
        const size_t at = (size_t)y * row + STUDIO_PIXEL * (size_t)r.left;
        memcpy(to->pixels + at, p->canvas + at, bytes);
    }
    to->stale = (struct studio_rectangle){0};
}

void studio_pictures_publish(struct studio_pictures *p, const struct studio_rectangle *changed,
                             unsigned long heard)
{
    for (int i = 0; i < 3; i++) /* only the thread that publishes looks at what is stale */
        p->places[i].stale = studio_rectangle_join(p->places[i].stale, *changed);
    struct studio_picture *now = &p->places[p->writing];
    stale_copy(p, now);
    now->changed = *changed;
    now->heard = heard;
    pthread_mutex_lock(&p->lock);
    if (p->fresh) /* one that nobody has seen */
        now->changed = studio_rectangle_join(now->changed, p->places[p->newest].changed);
    const int free_one = p->newest;
    p->newest = p->writing;
    p->writing = free_one;
    p->fresh = true;
    pthread_mutex_unlock(&p->lock);
}

const struct studio_picture *studio_pictures_take(struct studio_pictures *p)
{
    const struct studio_picture *taken = NULL;
    pthread_mutex_lock(&p->lock);
    if (p->fresh) {
        const int done_with = p->looking;
        p->looking = p->newest;
        p->newest = done_with;
        p->fresh = false;
        taken = &p->places[p->looking];
    }
    pthread_mutex_unlock(&p->lock);
    return taken;
}

bool studio_pictures_taken(struct studio_pictures *p)
{
    pthread_mutex_lock(&p->lock);
    const bool taken = !p->fresh;
    pthread_mutex_unlock(&p->lock);
    return taken;
}
