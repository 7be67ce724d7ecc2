/* alias.c - aliases: which of a root and its aliases holds the valid content, and where
 * their bits are. See reshape.h. */
#include "alias/alias.h"

#include "alias/reshape.h"
#include "base/errors.h"
#include "run/notes.h"

/* ---- who has the content ---- */

/* Whether the alias's VP ratio is a multiple or a divisor of its root's, and by what factor. */
static bool factor_of(const struct machine *m, struct field *alias, struct factor *out)
{
    struct field *root = alias->root;
    uint64_t ra = m->values->sets[root->vpset].ratio, rx = m->values->sets[alias->vpset].ratio;
    const struct view *v = &alias->view;
    if (rx % ra == 0) {
        uint32_t k = (uint32_t)(rx / ra), stride = alias->bits ? alias->bits : 1;
        bool fits = k == 1          ? v->parts == 1 && (ra == 1 || v->outer == root->bits)
                    : v->parts == k ? ra == 1 || v->outer == root->bits
                                    : ra == 1 && v->parts == 1;
        if (k > 1)
            stride = v->parts == k ? v->inner : v->outer;
        *out = (struct factor){alias, root, k, v->start, stride, alias->bits};
        return fits && stride > 0 &&
               (uint64_t)v->start + (uint64_t)(k - 1) * stride + alias->bits <= root->bits;
    }
    if (ra % rx == 0) {
        uint32_t k = (uint32_t)(ra / rx);
        *out = (struct factor){root, alias, k, 0, root->bits, root->bits};
        return v->start == 0 && v->parts == 1 && alias->bits == k * root->bits &&
               (rx == 1 || v->outer == alias->bits);
    }
    return false;
}

bool alias_settle(struct machine *m, struct field *root)
{
    struct field *from = root->newest;
    struct factor f;
    if (!from)
        return true;
    bool good = !factor_of(m, from, &f) ? reshape_through_image(m, root, from, root)
                : f.fine == from        ? reshape_coarse_from_fine(m, &f)
                                        : reshape_fine_from_coarse(m, &f);
    if (good)
        root->newest = NULL;
    return good;
}

static bool take_over(struct machine *m, struct field *alias)
{
    struct factor f;
    if (!factor_of(m, alias, &f))
        return reshape_through_image(m, alias->root, NULL, alias);
    return f.fine == alias ? reshape_fine_from_coarse(m, &f) : reshape_coarse_from_fine(m, &f);
}

bool alias_bring_over(struct machine *m, struct field *f, bool writes, bool whole)
{
    struct field *root = f->root ? f->root : f;
    if (!root->aliases)
        return true;
    if (f == root && writes && whole)
        root->newest = NULL;
    if (root->newest != f && !alias_settle(m, root))
        return false;
    if (f->root && !f->current) {
        if (!(writes && whole) && !take_over(m, f))
            return false;
        f->current = true;
    }
    if (writes) {
        for (struct field *a = root->aliases; a; a = a->next_alias)
            a->current = a == f;
        root->newest = f == root ? NULL : f;
    }
    return true;
}

/* ---- making aliases ---- */

/* Finds where VPs of a set of ratio `to` have their bits, if they share out the bits that
 * VPs of ratio `from` have from bit `offset` on of a view of `bits` bits. False: they
 * cannot. */
static bool view_divide(struct view v, uint32_t bits, uint32_t offset, uint64_t from,
                        uint64_t to, struct view *out, uint32_t *out_bits)
{
    bool even = v.parts == 1 || v.inner * v.parts == v.outer;
    uint32_t stride = v.parts == 1 ? v.outer : v.inner, left = bits - offset;
    *out = v;
    out->start += offset;
    if (to == from) {
        *out_bits = left;
    } else if (from == 1 || (to % from == 0 && even)) {
        uint32_t k = (uint32_t)(to / from);
        *out_bits = left / k;
        out->parts = k;
        out->outer = stride;
        out->inner = *out_bits;
    } else if (from % to == 0 && even) {
        uint32_t k = (uint32_t)(from / to);
        *out_bits = (k - 1) * stride + left;
        out->parts = 1;
        out->outer = k * stride;
        out->inner = 0;
    } else if (even && stride == bits) {
        *out_bits = (uint32_t)(((from - 1) * stride + left) / to);
        out->parts = 1;
        out->outer = *out_bits;
        out->inner = 0;
    } else {
        return false;
    }
    return true;
}

/* Makes the view of an alias of the field in the VP set. */
static bool view_make(struct machine *m, uint32_t field, int vpset, struct field **root,
                      struct view *view, uint32_t *bits)
{
    struct machine_field_info info;
    uint32_t offset = 0;
    if (!vpset_get(m, vpset))
        return false;
    if (!machine_field_lookup(m, field, &info)) {
        machine_fail(m, MACHINE_BAD_ARGUMENT, "there is no field %u (any more)", field);
        return false;
    }
    struct field *f = field_exact(m, info.base);
    offset = info.offset;
    *root = f->root ? f->root : f;
    if (!view_divide(reshape_view(f), f->bits, offset, m->values->sets[f->vpset].ratio,
                     m->values->sets[vpset].ratio, view, bits)) {
        machine_fail(
            m, MACHINE_BAD_ARGUMENT,
            "memory of a set of VP ratio %llu cannot be shared out among %llu VPs here: "
            "make the alias of the whole field",
            (unsigned long long)m->values->sets[f->vpset].ratio,
            (unsigned long long)m->values->sets[vpset].ratio);
        return false;
    }
    return true;
}

uint32_t machine_alias_make(struct machine *m, uint32_t field, int vpset)
{
    notes_forget(m);
    struct field *root;
    struct view view;
    uint32_t bits;
    if (!view_make(m, field, vpset, &root, &view, &bits))
        return MACHINE_NO_FIELD;
    uint32_t id = machine_field_allocate(m, vpset, bits, root->region);
    if (id == MACHINE_NO_FIELD)
        return id;
    struct field *f = field_exact(m, id);
    f->root = root;
    f->view = view;
    f->next_alias = root->aliases;
    root->aliases = f;
    return id;
}

static struct field *alias_exact(struct machine *m, uint32_t alias)
{
    struct field *f = field_exact(m, alias);
    if (f && f->root)
        return f;
    machine_fail(m, MACHINE_BAD_ARGUMENT, "%u is not an alias (any more)", alias);
    return NULL;
}

enum machine_status machine_alias_change(struct machine *m, uint32_t alias, uint32_t field)
{
    notes_forget(m);
    struct field *f = alias_exact(m, alias), *root;
    struct view view;
    uint32_t bits;
    if (!f || !view_make(m, field, f->vpset, &root, &view, &bits))
        return m->status;
    if (!field_room(m, f, bits))
        return machine_fail(m, MACHINE_BAD_ARGUMENT,
                            "an alias of %u bits cannot become one of %u: make another",
                            f->bits, bits);
    if (f->root->newest == f && !alias_settle(m, f->root))
        return m->status;
    field_unlink_alias(f);
    field_slots_put(m, f, 0, f->bits, NULL, 0);
    f->root = root;
    f->view = view;
    f->bits = bits;
    f->current = false;
    f->next_alias = root->aliases;
    root->aliases = f;
    return MACHINE_OK;
}

enum machine_status machine_alias_remove(struct machine *m, uint32_t alias)
{
    notes_forget(m);
    struct field *f = alias_exact(m, alias);
    if (!f)
        return m->status;
    if (f->root->newest == f && !alias_settle(m, f->root))
        return m->status;
    field_destroy(m, f);
    return MACHINE_OK;
}

bool machine_is_alias(struct machine *m, uint32_t field)
{
    struct machine_field_info info;
    if (!machine_field_lookup(m, field, &info))
        return false;
    const struct field *f = field_exact(m, info.base);
    return f && f->root;
}
