/* Proves that i7000.h and i7000_vectors.h, as your compiler reads them, have what spec/ has: the number of rows and a
 * CRC-32 of the values of each table and each section of vectors.
 *
 * Generated from spec/ by `python -m c.generate`. Do not edit. License: MIT.
 *
 *     cc -std=c99 i7000_selftest.c -o selftest && ./selftest
 */
#define I7000_DEFINE_TABLES
#define I7000_VECTORS_ALL
#include <stdio.h>

#include "i7000_vectors.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define EACH(array, count, walk) \
    for (size_t at = 0; at < (count); at++) \
    walk(&(array)[at])
#define LISTED(array, count, walk) \
    do { \
        size(count); \
        EACH(array, count, walk); \
    } while (0)

static uint32_t digest;
static unsigned failures;

static void byte(unsigned value)
{
    digest ^= value & 0xFFu;
    for (int bit = 0; bit < 8; bit++)
        digest = (digest & 1u) != 0 ? digest >> 1 ^ 0xEDB88320u : digest >> 1;
}

static void number(uint32_t value)
{
    for (unsigned shift = 0; shift < 32; shift += 8)
        byte((unsigned)(value >> shift));
}

static void integer(int32_t value) { number((uint32_t)value); }

static void size(size_t value) { number((uint32_t)value); }

static void real(double value)
{
    uint64_t millionths = (uint64_t)(int64_t)(value * 1e6);
    number((uint32_t)millionths);
    number((uint32_t)(millionths >> 32));
}

static void text(const char *value)
{
    if (value == NULL) {
        byte(0xFF);
        return;
    }
    do
        byte((unsigned char)*value);
    while (*value++ != '\0');
}

static void wire(const uint8_t *bytes, size_t count)
{
    size(count);
    for (size_t at = 0; at < count; at++)
        byte(bytes[at]);
}

static void codes(const uint8_t *values, size_t count)
{
    size(count);
    for (size_t at = 0; at < count; at++)
        number(values[at]);
}

static void texts(const char *const *values, size_t count)
{
    size(count);
    for (size_t at = 0; at < count; at++)
        text(values[at]);
}

static void reals(const double *values, size_t count)
{
    size(count);
    for (size_t at = 0; at < count; at++)
        real(values[at]);
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

static void type(const i7000_type *it)
{
    text(it->name), number(it->unit), number(it->decimals), number(it->is_hex_signed), number(it->is_thermocouple);
    integer(it->minimum), integer(it->maximum), integer(it->max), number(it->hex_minimum), number(it->hex_maximum);
    integer(it->modbus_minimum), integer(it->modbus_maximum), number(it->modbus_counts_per_unit);
    text(it->percent_minimum), text(it->percent_maximum);
}

static void sentinel(const i7000_sentinel *it)
{
    number(it->status), number(it->format), number(it->is_legacy), number(it->types), text(it->text), number(it->word);
}

static void model(const i7000_model *it)
{
    text(it->name), number(it->series), number(it->has_modbus), number(it->channels), number(it->single_ended_channels);
    number(it->is_single_ended_by_command), number(it->mask_digits), number(it->mask_digits_single_ended);
    number(it->default_type), number(it->uses_tt), number(it->has_cjc);
    number(it->has_open_wire_detection), number(it->has_fast_mode), number(it->types), number(it->later_types);
    number(it->later_types_from), number(it->individual_types_from), number(it->filter_from);
    number(it->character_formats_from);
}

static void gate(const i7000_gate *it) { number(it->models), number(it->firmware); }

static void part(const i7000_part *it)
{
    text(it->notation), number(it->field), number(it->kind), number(it->width), number(it->digits);
    number(it->most_digits), integer(it->minimum), integer(it->maximum);
}

static void dcon_command(const i7000_dcon_command *it)
{
    text(it->name), text(it->section), text(it->syntax), text(it->response_syntax), number(it->response);
    LISTED(it->parts, it->part_count, part);
    LISTED(it->response_parts, it->response_part_count, part);
    LISTED(it->gates, it->gate_count, gate);
    number(it->pause_ms), number(it->pause_is_until_done), number(it->pause_from), number(it->pause_to);
}

static void token(const i7000_token *it)
{
    number(it->kind), number(it->bytes), number(it->value), number(it->field), integer(it->minimum);
    integer(it->maximum);
}

static void modbus_request(const i7000_modbus_request *it)
{
    text(it->name), text(it->section), number(it->function), number(it->sub_function), number(it->is_broadcast);
    number(it->minimum_count), number(it->maximum_count), number(it->response_message), text(it->request);
    text(it->response);
    LISTED(it->tokens, it->token_count, token);
    LISTED(it->response_tokens, it->response_token_count, token);
    LISTED(it->gates, it->gate_count, gate);
}

static void value(const i7000_value *it) { number(it->number), text(it->meaning); }

static void row(const i7000_register *it)
{
    text(it->name), text(it->unit), number(it->counts_per_unit), number(it->number), number(it->address);
    number(it->count), number(it->area), number(it->access), number(it->type), integer(it->minimum);
    integer(it->maximum);
    LISTED(it->values, it->value_count, value);
    number(it->models), number(it->firmware);
}

static void map(const i7000_map *it)
{
    text(it->section), number(it->models), number(it->firmware), number(it->maximum_write_count);
    LISTED(it->rows, it->row_count, row);
}

static void name(const char *const *it) { text(*it); }

/* --- vectors ------------------------------------------------------------------------------------------------------ */

static void profile(const i7000_profile *it)
{
    if (it == NULL) {
        byte(0xFF);
        return;
    }
    number(it->model), number(it->data_format), number(it->modbus_format), number(it->has_checksum);
    number(it->is_single_ended), number(it->channels), number(it->firmware);
    for (size_t at = 0; at < sizeof it->types; at++)
        number(it->types[at]);
}

static void field(const i7000_vector_field *it)
{
    number(it->field), integer(it->number), text(it->text), texts(it->texts, it->texts == NULL ? 0 : it->count);
    size(it->words == NULL ? 0 : it->count);
    for (size_t at = 0; it->words != NULL && at < it->count; at++)
        number(it->words[at]);
}

static void message(const i7000_vector_message *it)
{
    if (it == NULL) {
        byte(0xFF);
        return;
    }
    number(it->message);
    LISTED(it->fields, it->field_count, field);
}

static void exchange(const i7000_exchange *it)
{
    text(it->id), text(it->section), text(it->erratum), profile(it->profile), number(it->outcome), number(it->fault);
    number(it->source), number(it->flags), wire(it->command, it->command_size), message(it->command_message);
    wire(it->response, it->response_size), message(it->response_message);
}

static void reading_vector(const i7000_reading_vector *it)
{
    text(it->id), text(it->section), text(it->erratum), number(it->source), number(it->flags), number(it->type);
    number(it->format), number(it->direction), number(it->status), number(it->fault), text(it->text), real(it->value);
}

static void line_vector(const i7000_line_vector *it)
{
    text(it->id), text(it->section), text(it->erratum), number(it->source), profile(it->profile), text(it->line);
    texts(it->texts, it->count), codes(it->statuses, it->count), size(it->count);
}

static void channels_vector(const i7000_channels_vector *it)
{
    text(it->id), text(it->section), text(it->erratum), number(it->source), profile(it->profile), message(it->command);
    message(it->response), reals(it->values, it->count), codes(it->units, it->count), codes(it->statuses, it->count);
    size(it->count);
}

static void register_vector(const i7000_register_vector *it)
{
    text(it->id), text(it->section), text(it->erratum), number(it->source), profile(it->profile), text(it->name);
    number(it->first), number(it->is_big_endian), number(it->direction), number(it->fault), size(it->item_count);
    for (size_t at = 0; at < it->item_count; at++)
        number(it->items[at]);
    reals(it->values, it->count), codes(it->statuses, it->statuses == NULL ? 0 : it->count), size(it->count);
}

static void check_vector(const i7000_check_vector *it)
{
    text(it->id), text(it->section), wire(it->body, it->size), wire(it->check, it->check_size);
}

static void event(const i7000_event *it) { number(it->fault), wire(it->bytes, it->size); }

static void split_vector(const i7000_split_vector *it)
{
    text(it->id), text(it->section), text(it->erratum), number(it->source), number(it->has_checksum), number(it->side);
    profile(it->profile), wire(it->stream, it->size);
    LISTED(it->events, it->event_count, event);
    wire(it->rest, it->rest_size);
    LISTED(it->flushed, it->flushed_count, event);
}

/* --- checks ------------------------------------------------------------------------------------------------------- */

static void expect(const char *array, size_t count, size_t expected_count, uint32_t expected)
{
    if (count == expected_count && (digest ^ 0xFFFFFFFFu) == expected)
        return;
    failures++;
    printf("%s: %lu rows with CRC %08lX, expected %lu with %08lX\n", array, (unsigned long)count,
           (unsigned long)(digest ^ 0xFFFFFFFFu), (unsigned long)expected_count, (unsigned long)expected);
}

#define CHECK(array, walk, expected_count, expected) \
    do { \
        digest = 0xFFFFFFFFu; \
        EACH(array, COUNT(array), walk); \
        expect(#array, COUNT(array), expected_count, expected); \
    } while (0)

int main(void)
{
    size_t exchanges = 0, readings = 0;
    CHECK(i7000_types, type, 29, 0x7E194F64u);
    CHECK(i7000_sentinels, sentinel, 27, 0xDD647A64u);
    CHECK(i7000_models, model, 28, 0xFC934397u);
    CHECK(i7000_dcon_commands, dcon_command, 43, 0xB2B3CBECu);
    CHECK(i7000_modbus_functions, modbus_request, 8, 0x3E68AC30u);
    CHECK(i7000_module_settings, modbus_request, 17, 0x987F9E6Eu);
    CHECK(i7000_maps, map, 9, 0x4302A883u);
    CHECK(i7000_fault_names, name, 18, 0x0F1DC49Fu);
    CHECK(i7000_field_names, name, 35, 0xC4F59178u);
    CHECK(i7000_dcon_names, name, 64, 0x824CAEE3u);
    CHECK(i7000_modbus_names, name, 51, 0x09375229u);
    CHECK(i7000_status_names, name, 4, 0x5C1EC287u);
    CHECK(i7000_unit_names, name, 4, 0x7EF32939u);
    CHECK(i7000_vectors_dcon_2_1, exchange, 54, 0xDF2B099Fu);
    CHECK(i7000_vectors_dcon_2_2, exchange, 11, 0x22583781u);
    CHECK(i7000_vectors_dcon_2_3, exchange, 71, 0xFCEAD5B2u);
    CHECK(i7000_vectors_dcon_2_4, exchange, 52, 0x34CA6AE9u);
    CHECK(i7000_vectors_dcon_2_5, exchange, 26, 0xC2442084u);
    CHECK(i7000_vectors_dcon_2_6, exchange, 25, 0x9F8F36CDu);
    CHECK(i7000_vectors_dcon_2_7, exchange, 25, 0x29D69324u);
    CHECK(i7000_vectors_dcon_2_8, exchange, 30, 0x8DC9F588u);
    CHECK(i7000_vectors_dcon_2_9, exchange, 26, 0xB7F891A7u);
    CHECK(i7000_vectors_dcon_2_10, exchange, 59, 0x02E7A576u);
    CHECK(i7000_vectors_dcon_2_11, exchange, 27, 0xE1DD9AE3u);
    CHECK(i7000_vectors_dcon_2_12, exchange, 32, 0x67B8B0EDu);
    CHECK(i7000_vectors_dcon_2_13, exchange, 38, 0x595566D0u);
    CHECK(i7000_vectors_dcon_2_14, exchange, 29, 0x39B4C0F8u);
    CHECK(i7000_vectors_dcon_2_15, exchange, 51, 0xB4BE6A06u);
    CHECK(i7000_vectors_dcon_2_16, exchange, 42, 0x064A9CE7u);
    CHECK(i7000_vectors_dcon_2_17, exchange, 29, 0xC294ECDDu);
    CHECK(i7000_vectors_dcon_2_18, exchange, 35, 0xEB78DAA4u);
    CHECK(i7000_vectors_dcon_2_19, exchange, 26, 0xF56C846Au);
    CHECK(i7000_vectors_dcon_2_20, exchange, 22, 0x062BAB86u);
    CHECK(i7000_vectors_dcon_2_21, exchange, 22, 0x48E15296u);
    CHECK(i7000_vectors_dcon_2_22, exchange, 26, 0xA8B84759u);
    CHECK(i7000_vectors_dcon_2_23, exchange, 26, 0x6B3E851Cu);
    CHECK(i7000_vectors_dcon_2_24, exchange, 36, 0x09299BE6u);
    CHECK(i7000_vectors_dcon_2_25, exchange, 23, 0x15322AF8u);
    CHECK(i7000_vectors_dcon_2_26, exchange, 23, 0xD4F71E0Eu);
    CHECK(i7000_vectors_dcon_2_27, exchange, 24, 0xCA03CD0Cu);
    CHECK(i7000_vectors_dcon_2_28, exchange, 20, 0x91A23A49u);
    CHECK(i7000_vectors_dcon_2_29, exchange, 21, 0x114167C5u);
    CHECK(i7000_vectors_dcon_2_30, exchange, 21, 0xC3744E58u);
    CHECK(i7000_vectors_dcon_2_31, exchange, 27, 0xEC0AE859u);
    CHECK(i7000_vectors_dcon_2_32, exchange, 20, 0x4200467Au);
    CHECK(i7000_vectors_dcon_2_33, exchange, 30, 0x5E2D94D8u);
    CHECK(i7000_vectors_dcon_2_34, exchange, 31, 0x7007A1D6u);
    CHECK(i7000_vectors_dcon_2_35, exchange, 12, 0x62F94768u);
    CHECK(i7000_vectors_dcon_2_36, exchange, 21, 0xFD3C461Bu);
    CHECK(i7000_vectors_dcon_2_37, exchange, 19, 0x81CF83BFu);
    CHECK(i7000_vectors_dcon_2_38, exchange, 24, 0x1573A414u);
    CHECK(i7000_vectors_dcon_2_39, exchange, 27, 0xF1C3A1D1u);
    CHECK(i7000_vectors_dcon_2_40, exchange, 37, 0x1029412Cu);
    CHECK(i7000_vectors_dcon_2_41, exchange, 27, 0x82B07923u);
    CHECK(i7000_vectors_dcon_2_42, exchange, 23, 0x6327C1B4u);
    CHECK(i7000_vectors_dcon_2_43, exchange, 23, 0x9E8CB7A8u);
    CHECK(i7000_vectors_modbus_3_4_1, exchange, 64, 0xF1E96F26u);
    CHECK(i7000_vectors_modbus_3_4_2, exchange, 50, 0x69322A65u);
    CHECK(i7000_vectors_modbus_3_4_3, exchange, 144, 0x050AF3AAu);
    CHECK(i7000_vectors_modbus_3_4_4, exchange, 60, 0xFD77D668u);
    CHECK(i7000_vectors_modbus_3_4_5, exchange, 68, 0xB97DDBD8u);
    CHECK(i7000_vectors_modbus_3_4_6, exchange, 63, 0x381D4A93u);
    CHECK(i7000_vectors_modbus_3_4_7, exchange, 62, 0xB1F51B95u);
    CHECK(i7000_vectors_modbus_3_4_8, exchange, 81, 0x47209F26u);
    CHECK(i7000_vectors_modbus_3_4_9, exchange, 78, 0x756B8B82u);
    CHECK(i7000_vectors_modbus_01, exchange, 42, 0xC0AF6EAEu);
    CHECK(i7000_vectors_modbus_02, exchange, 36, 0x24022217u);
    CHECK(i7000_vectors_modbus_03, exchange, 35, 0xCA0765D1u);
    CHECK(i7000_vectors_modbus_04, exchange, 46, 0x7F073FB0u);
    CHECK(i7000_vectors_modbus_05, exchange, 30, 0x02C2C0A8u);
    CHECK(i7000_vectors_modbus_06, exchange, 26, 0xB844A9F6u);
    CHECK(i7000_vectors_modbus_0f, exchange, 37, 0xD5DB04EAu);
    CHECK(i7000_vectors_modbus_10, exchange, 38, 0xCD2581A5u);
    CHECK(i7000_vectors_modbus_46_00, exchange, 24, 0x0D91654Cu);
    CHECK(i7000_vectors_modbus_46_04, exchange, 29, 0x3EB74AB8u);
    CHECK(i7000_vectors_modbus_46_05, exchange, 29, 0x5D379D9Du);
    CHECK(i7000_vectors_modbus_46_06, exchange, 37, 0x25561A20u);
    CHECK(i7000_vectors_modbus_46_07, exchange, 27, 0xBB7F6DFEu);
    CHECK(i7000_vectors_modbus_46_08, exchange, 28, 0x813D9B87u);
    CHECK(i7000_vectors_modbus_46_20, exchange, 21, 0xF7205877u);
    CHECK(i7000_vectors_modbus_46_25, exchange, 31, 0x82A487A5u);
    CHECK(i7000_vectors_modbus_46_26, exchange, 28, 0x8DEC5F58u);
    CHECK(i7000_vectors_modbus_46_29, exchange, 24, 0x266FAA43u);
    CHECK(i7000_vectors_modbus_46_2a, exchange, 27, 0x0266AE48u);
    CHECK(i7000_vectors_modbus_46_2b, exchange, 30, 0x4272C085u);
    CHECK(i7000_vectors_modbus_46_2c, exchange, 30, 0x6DB01FBFu);
    CHECK(i7000_vectors_modbus_46_2d, exchange, 23, 0x67225ACDu);
    CHECK(i7000_vectors_modbus_46_2e, exchange, 24, 0x148854C7u);
    CHECK(i7000_vectors_modbus_46_2f, exchange, 23, 0x063466AFu);
    CHECK(i7000_vectors_modbus_46_30, exchange, 23, 0xFA447D47u);
    CHECK(i7000_vectors_frames_crc, check_vector, 19, 0x2EEF8807u);
    CHECK(i7000_vectors_frames_split, split_vector, 56, 0xF0B0AD1Eu);
    CHECK(i7000_vectors_readings_hex, reading_vector, 292, 0x54F106BFu);
    CHECK(i7000_vectors_modbus_frames, exchange, 53, 0xE9BCFB53u);
    CHECK(i7000_vectors_registers_rows, register_vector, 150, 0x7ADD5353u);
    CHECK(i7000_vectors_readings_legacy, line_vector, 18, 0x9147A2D3u);
    CHECK(i7000_vectors_frames_checksums, check_vector, 19, 0x7971042Fu);
    CHECK(i7000_vectors_frames_rtu_split, split_vector, 79, 0x4F82018Bu);
    CHECK(i7000_vectors_readings_percent, reading_vector, 480, 0x45546308u);
    CHECK(i7000_vectors_readings_channels, channels_vector, 26, 0x429CF48Cu);
    CHECK(i7000_vectors_readings_rejected, reading_vector, 36, 0x9FB8B363u);
    CHECK(i7000_vectors_registers_readings, register_vector, 77, 0xAF366613u);
    CHECK(i7000_vectors_readings_engineering, reading_vector, 525, 0x03E0FC1Bu);
    for (size_t at = 0; at < COUNT(i7000_exchange_sections); at++)
        exchanges += i7000_exchange_sections[at].count;
    for (size_t at = 0; at < COUNT(i7000_reading_sections); at++)
        readings += i7000_reading_sections[at].count;
    if (exchanges != 2744)
        failures++, printf("%lu exchanges in all, expected 2744\n", (unsigned long)exchanges);
    if (readings != 1333)
        failures++, printf("%lu readings in all, expected 1333\n", (unsigned long)readings);
    printf("%u arrays differ from spec/\n", failures);
    return failures == 0 ? 0 : 1;
}
