"""The fuzzer's table: tests/fuzz/fuzz_calls.c."""

# Calls that the fuzzer makes itself, or must not make: they end what is under way.
FUZZ_NOT = {"CM_set_error_handler", "CM_init", "CM_cold_boot", "CM_warm_boot", "CM_attach", "CM_attach_to_processors",
            "CM_detach", "CM_timer_print", "CM_set_safety_mode", "CM_u_print_field_1L", "CM_s_print_field_1L", "CM_f_print_field_1L",
            "CM_print_context"}
# What makes kernels and runs them.
FUZZ_OBSERVES = ("global", "read_from", "news_array", "write_to_processor", "timer_", "latch_leds", "leds_mode",
                 "scan_with", "spread", "reduce_with", "rank", "enumerate", "CM_send", "CM_get", "cross_vp", "aref", "aset",
                 "set_vp_set_geometry")
FUZZ_BY_TYPE = {"CM_field_id_t": "field", "CM_vp_set_id_t": "vp_set", "CM_geometry_id_t": "geometry",
                "CM_sendaddr_t": "address", "CM_axis_descriptor_t *": "descriptors", "const void *": "array",
                "void *": "array", "double": "double", "unsigned long": "word", "long": "word"}
FUZZ_BY_NAME = {"axis": "axis", "direction": "small", "inclusion": "small", "smode": "small", "rank": "rank",
                "format": "small", "timer": "small", "dimension_vector": "dimensions", "dimensions": "dimensions",
                "send_address": "address", "offset": "offset"}
FUZZ_KEEPS = ("CM_field_id_t", "CM_vp_set_id_t", "CM_geometry_id_t")


def fuzz_argument(kind, name):
    """The function that makes such an argument of the fuzzer's bytes; None: there is none."""
    if name in FUZZ_BY_NAME and kind != "CM_field_id_t":
        return FUZZ_BY_NAME[name]
    if kind == "CM_vector_t":
        return "vector"
    if kind in FUZZ_BY_TYPE:
        return FUZZ_BY_TYPE[kind]
    if "*" in kind or "(" in kind:
        return None
    letters = name.lstrip("ds")
    if name in ("s", "ss", "ds"):
        return "significand"
    if letters == "e":
        return "exponent"
    return "length" if "len" in name else "number"


def fuzz_params(f):
    """[(type, name)], of a call's prototype too."""
    if not (f.params and f.params[0][0] == ""):
        return f.params
    if f.params[0][1] == "void":
        return []
    out = []
    for text in f.params[0][1].split(","):
        text = text.strip()
        name = text.split()[-1].lstrip("*")
        out.append((text[:len(text) - len(name)].strip(), name))
    return out


def fuzz(sections):
    """A function for each call that makes its arguments of bytes, and a table of them."""
    calls, table = [], []
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if f.name in FUZZ_NOT:
                    continue
                arguments = [(t, fuzz_argument(t, n)) for t, n in fuzz_params(f)]
                if any(how is None for _, how in arguments):
                    continue
                # One after the other: the order in which C makes the arguments of a call is not said.
                lines = []
                for i, (kind, how) in enumerate(arguments):
                    cast = "" if "*" in kind or kind == "CM_vector_t" else f"({kind})"
                    lines.append(f"    {kind}{'' if kind.endswith('*') else ' '}a{i} = {cast}fuzz_{how}(f);")
                call = f"{f.name}({', '.join(f'a{i}' for i in range(len(arguments)))})"
                if f.result in FUZZ_KEEPS:
                    call = f"fuzz_keep_{f.result[3:-2]}(f, {call})"
                elif f.result != "void":
                    call = f"(void){call}"
                if not arguments and f.result not in FUZZ_KEEPS:
                    lines.append("    (void)f;")
                body = "\n".join(lines + [f"    {call};"])
                calls.append(f"static void fuzz_call_{f.name}(struct fuzz *f)\n{{\n{body}\n}}")
                observes = int(any(word in f.name for word in FUZZ_OBSERVES))
                table.append(f'    {{"{f.name}", fuzz_call_{f.name}, {observes}}},')
    return "\n".join(["/* Generated from instructions.tab: every call, with arguments made of the fuzzer's bytes. */",
                      *calls, "", "static const struct fuzz_row fuzz_rows[] = {", *table, "};", ""])
