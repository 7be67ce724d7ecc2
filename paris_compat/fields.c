/* Fields: allocation, parts, and queries. */
#include "paris_state.h"

static CM_field_id_t allocate(const char *name, unsigned int len, CM_vp_set_id_t vp_set,
                              enum machine_region region)
{
    struct machine *m = paris_inquire(name);
    if (len == 0 && region == MACHINE_HEAP &&
        !paris_let_pass("len: a field of 0 bits on the heap")) {
        paris_fail("len: a field on the heap has 1 bit or more (got 0)");
        return CM_no_field;
    }
    uint32_t field =
        machine_field_allocate(m, vp_set ? vp_set : machine_vpset_current(m), len, region);
    if (field == MACHINE_NO_FIELD)
        paris_fail_machine();
    paris_the.pristine = false;
    return field;
}

static bool set_good(const char *name, CM_vp_set_id_t vp_set)
{
    paris_machine();
    paris_the.call = name;
    if (CM_is_vp_set_valid(vp_set))
        return true;
    paris_fail("vp_set: %d is not a VP set (any more): make it with CM_allocate_vp_set",
               vp_set);
    return false;
}

CM_field_id_t CM_allocate_stack_field(unsigned int len)
{
    return allocate("CM_allocate_stack_field", len, 0, MACHINE_STACK);
}

CM_field_id_t CM_allocate_heap_field(unsigned int len)
{
    return allocate("CM_allocate_heap_field", len, 0, MACHINE_HEAP);
}

CM_field_id_t CM_allocate_stack_field_vp_set(unsigned int len, CM_vp_set_id_t vp_set)
{
    const char *name = "CM_allocate_stack_field_vp_set";
    return set_good(name, vp_set) ? allocate(name, len, vp_set, MACHINE_STACK) : CM_no_field;
}

CM_field_id_t CM_allocate_heap_field_vp_set(unsigned int len, CM_vp_set_id_t vp_set)
{
    const char *name = "CM_allocate_heap_field_vp_set";
    return set_good(name, vp_set) ? allocate(name, len, vp_set, MACHINE_HEAP) : CM_no_field;
}

void CM_deallocate_stack_through(CM_field_id_t field)
{
    struct machine *m = paris_begin("CM_deallocate_stack_through");
    if (machine_field_deallocate_through(m, field) != MACHINE_OK)
        paris_fail_machine();
}

void CM_deallocate_heap_field(CM_field_id_t field)
{
    struct machine *m = paris_begin("CM_deallocate_heap_field");
    if (machine_field_deallocate(m, field) != MACHINE_OK)
        paris_fail_machine();
}

void CM_compress_heap(void)
{
    paris_the.call = "CM_compress_heap";
}

/* ---- inquiries ---- */

static bool field_info(const char *name, CM_field_id_t field, struct machine_field_info *info)
{
    struct machine *m = paris_machine();
    paris_the.call = name;
    if (machine_field_lookup(m, field, info))
        return true;
    paris_fail("field: %u is not a field: it was never allocated, has been deallocated, or an "
               "offset led out of it",
               field);
    return false;
}

/* Programs that step through a field compute one address too many at its end, so only the
 * start must be in a field. */
CM_field_id_t CM_add_offset_to_field_id(CM_field_id_t field, int offset)
{
    struct machine_field_info info;
    if (paris_the.safety && !field_info("CM_add_offset_to_field_id", field, &info))
        return CM_no_field;
    return field + (unsigned int)offset;
}

static bool field_in(CM_field_id_t field, enum machine_region region)
{
    struct machine_field_info info;
    return machine_field_lookup(paris_machine(), field, &info) && info.region == region;
}

int CM_is_field_valid(CM_field_id_t field)
{
    struct machine_field_info info;
    return machine_field_lookup(paris_machine(), field, &info);
}

int CM_is_field_in_stack(CM_field_id_t field)
{
    return field_in(field, MACHINE_STACK);
}

int CM_is_field_in_heap(CM_field_id_t field)
{
    return field_in(field, MACHINE_HEAP);
}

int CM_is_stack_field_newer(CM_field_id_t field1, CM_field_id_t field2)
{
    struct machine_field_info a, b;
    const char *name = "CM_is_stack_field_newer";
    return field_info(name, field1, &a) && field_info(name, field2, &b) && a.base > b.base;
}

unsigned int CM_field_length(CM_field_id_t field)
{
    struct machine_field_info info;
    return field_info("CM_field_length", field, &info) ? info.bits - info.offset : 0;
}

CM_vp_set_id_t CM_field_vp_set(CM_field_id_t field)
{
    struct machine_field_info info;
    return field_info("CM_field_vp_set", field, &info) ? info.vpset : 0;
}
