/* open.c - opens the whole library: all functions, and the types that they belong to. */
#include "script_internal.h"

#include <string.h>

const struct script_functions script_functions[] = {
    {NULL, script_sandbox_functions, false},
    {NULL, script_song_functions, false},
    {NULL, script_mask_makers, false},
    {NULL, script_page_makers, false},
    {NULL, script_typeface_makers, false},
    {NULL, script_paper_time_functions, false},
    {NULL, script_stroke_functions, false},
    {NULL, script_picture_functions, false},
    {script_mask_type, script_mask_methods, false},
    {script_mask_type, script_mask_operators, true},
    {script_papers_type, script_papers_operators, true},
    {script_papers_type, script_papers_functions, false},
    {script_paper_type, script_paper_methods, false},
    {script_paper_type, script_paper_look_methods, false},
    {script_paper_type, script_paper_time_methods, false},
    {script_paper_type, script_brush_paper_methods, false},
    {script_paper_type, script_stroke_methods, false},
    {script_paper_type, script_technique_methods, false},
    {script_paper_type, script_picture_paper_methods, false},
    {script_brush_type, script_brush_methods, false},
    {script_picture_type, script_picture_methods, false},
    {script_spring_type, script_spring_makers, false},
    {script_spring_type, script_spring_word_makers, false},
    {script_network_type, script_network_methods, false},
    {script_network_type, script_network_word_methods, false},
    {script_network_type, script_network_key_methods, false},
    {script_network_type, script_network_machine_methods, false},
    {NULL, NULL, false}};

void script_functions_list(void (*each)(const char *type, const char *name))
{
    static const char before[] = "lutetia ";
    for (const struct script_functions *f = script_functions; f->functions; f++)
        for (const luaL_Reg *row = f->functions; row->name && !f->operators; row++)
            each(f->of ? f->of + strlen(before) : "", row->name);
}

/* A metatable's __index is the table of methods or, for papers, a function with that table
 * as upvalue. */
static void functions_open(lua_State *L, const struct script_functions *f)
{
    int top = lua_gettop(L);
    if (!f->of)
        lua_pushglobaltable(L);
    else
        luaL_getmetatable(L, f->of);
    if (f->of && !f->operators)
        lua_getfield(L, -1, "methods");
    script_functions_set(L, f->functions);
    lua_settop(L, top);
}

int script_open(lua_State *L)
{
    script_of(L)->main = L;
    script_sandbox_open(L);
    script_limits_open(L);
    script_call_open(L);
    script_mask_open(L);
    script_paper_open(L);
    script_paper_time_open(L);
    script_brush_open(L);
    script_stroke_open(L);
    script_picture_open(L);
    script_springs_open(L);
    script_springs_machine_open(L);
    script_song_open(L);
    script_typeface_open(L);
    for (const struct script_functions *f = script_functions; f->functions; f++)
        functions_open(L, f);
    return 0;
}
