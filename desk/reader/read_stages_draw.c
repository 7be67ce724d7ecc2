/* read_stages_draw.c - demonstrations in the page as they are seen: their pictures, frames and
 * strips. */
#include "read_stages.h"

static void frame_draw(const struct read_desk *d, GtkSnapshot *snapshot,
                       const graphene_rect_t *box, bool keyed)
{
    const double *c = keyed ? d->colours->link : d->colours->struck;
    const float width = keyed ? 2 : 1;
    const GdkRGBA rgba = {(float)c[0], (float)c[1], (float)c[2], 1};
    GskRoundedRect outline;
    gsk_rounded_rect_init_from_rect(&outline, box, 0);
    gtk_snapshot_append_border(snapshot, &outline, (const float[]){width, width, width, width},
                               (const GdkRGBA[]){rgba, rgba, rgba, rgba});
}

/* Tab has come to it. */
static bool is_focused(const struct read_desk *d, const struct stage *s)
{
    return gtk_widget_has_focus(d->page) && d->focused == d->document->blocks[s->block].at;
}

void read_stages_draw(struct read_desk *d, GtkSnapshot *snapshot)
{
    for (guint i = 0; i < d->stages->all->len; i++) {
        const struct stage *s = g_ptr_array_index(d->stages->all, i);
        const graphene_rect_t box =
            GRAPHENE_RECT_INIT((float)s->place.x, (float)s->place.y, (float)s->place.width,
                               (float)s->place.height);
        if (!s->seen)
            continue;
        if (s->texture)
            gtk_snapshot_append_texture(snapshot, s->texture, &box);
        frame_draw(d, snapshot, &box, d->stages->keyed == s || is_focused(d, s));
        gtk_widget_snapshot_child(d->page, s->strip, snapshot);
    }
}
