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
/* @checks */
    for (size_t at = 0; at < COUNT(i7000_exchange_sections); at++)
        exchanges += i7000_exchange_sections[at].count;
    for (size_t at = 0; at < COUNT(i7000_reading_sections); at++)
        readings += i7000_reading_sections[at].count;
/* @totals */
    printf("%u arrays differ from spec/\n", failures);
    return failures == 0 ? 0 : 1;
}
