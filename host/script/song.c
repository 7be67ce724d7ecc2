/* song.c - what instruments play, in scripts: messages as tables, and song("page.mid"), a list
 * of them. */
#include "script_internal.h"

#include <midi_message.h>
#include <midi_song.h>

#include <sys/stat.h>

enum { EVENT_BYTES = 400 /* of a message as a table */ };
/* Bytes of a song for each of its file's: the shortest event has two, and its place in the song
 * and in its order has 64. */
#define FILE_FACTOR 33.0

/* ---- messages ---- */

static void number_set(lua_State *L, const char *name, double value)
{
    lua_pushnumber(L, value);
    lua_setfield(L, -2, name);
}

static void integer_set(lua_State *L, const char *name, int value)
{
    lua_pushinteger(L, value);
    lua_setfield(L, -2, name);
}

/* A message as a table: kind and time; of channel messages channel and what it has, values as
 * 0..1 (bend: -1..1); the bytes of all others as a text. */
void script_midi_push(lua_State *L, const struct midi_message *m)
{
    const struct midi_row *row = midi_row_of(m->bytes[0]);
    lua_createtable(L, 0, 6);
    lua_pushstring(L, midi_message_releases(m) ? "note-off" : row ? row->name : "sysex");
    lua_setfield(L, -2, "kind");
    number_set(L, "time", (double)m->time_ns * 1e-9);
    if (midi_message_channel(m) < 0) {
        lua_pushlstring(L, (const char *)m->bytes, m->count);
        lua_setfield(L, -2, "bytes");
        return;
    }
    const int status = m->bytes[0] & 0xf0, first = m->bytes[1];
    const int second = m->count > 2 ? m->bytes[2] : 0;
    integer_set(L, "channel", midi_message_channel(m) + 1);
    if (status == MIDI_NOTE_OFF || status == MIDI_NOTE_ON || status == MIDI_POLY_PRESSURE)
        integer_set(L, "note", first);
    if (status == MIDI_CONTROL)
        integer_set(L, "control", first);
    if (status == MIDI_PROGRAM)
        integer_set(L, "program", first);
    if (status == MIDI_BEND)
        number_set(L, "value", (first + 128 * second - 8192) / 8192.0);
    else if (status != MIDI_PROGRAM)
        number_set(L, "value", (status == MIDI_PRESSURE ? first : second) / 127.0);
}

/* ---- songs ---- */

static const char song_type[] = "lutetia song";

/* A song lives in a box, and is gone with it. */
static int song_gc(lua_State *L)
{
    struct midi_song **box = luaL_checkudata(L, 1, song_type);
    midi_song_destroy(*box);
    *box = NULL;
    return 0;
}

static struct midi_song **song_box(lua_State *L)
{
    struct midi_song **box = lua_newuserdatauv(L, sizeof *box, 0);
    *box = NULL;
    luaL_setmetatable(L, song_type);
    return box;
}

/* song("page.mid"): {messages of channels…, seconds = } */
static int song(lua_State *L)
{
    lua_settop(L, 1);
    const char *path =
        script_path(L, script_of(L)->config->in_folder, luaL_checkstring(L, 1), "song");
    struct midi_song **box = song_box(L);
    struct stat status;
    script_memory_hold(L, stat(path, &status) == 0 ? FILE_FACTOR * (double)status.st_size : 0,
                       "a song");
    const int hold = lua_gettop(L);
    if (midi_song_read(path, box) != MIDI_OK)
        script_fail(L, midi_error());
    const struct midi_song_info info = midi_song_info(*box);
    if ((double)info.events_count * EVENT_BYTES > script_memory_left(script_of(L)))
        luaL_error(L, "not enough memory for a song of %d events", (int)info.events_count);
    lua_newtable(L);
    lua_Integer count = 0;
    for (size_t i = 0; i < info.events_count; i++) {
        const struct midi_song_event e = midi_song_event(*box, i);
        if (e.kind != MIDI_SONG_MESSAGE)
            continue;
        const bool two = midi_row_of(e.bytes[0])->data_count > 1;
        const struct midi_message m =
            midi_message_make(e.time_ns, e.bytes[0], e.bytes[1], two ? e.bytes[2] : 0);
        if (i % 1024 == 0)
            script_check(L);
        script_midi_push(L, &m);
        lua_rawseti(L, -2, ++count);
    }
    lua_pushnumber(L, (double)info.end_ns * 1e-9);
    lua_setfield(L, -2, "seconds");
    midi_song_destroy(*box);
    *box = NULL;
    script_memory_release(L, hold);
    return 1;
}

void script_song_open(lua_State *L)
{
    script_type_open(L, song_type, song_gc);
}

const luaL_Reg script_song_functions[] = {{"song", song}, {NULL, NULL}};
