/* A wrapper of codec.c for `i7000 vectors -- c/example/runner`: cases in, answers out, JSON, one object a line.
 * The protocol is in docs/port_the_codec.md. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "codec.h"

#define LINE_SIZE 65600

static char line[LINE_SIZE];
static uint8_t bytes[LINE_SIZE / 2];
static int has_crashed; /* the case has something that is not foreseen here */

/* --- reading JSON: a value is a pointer to its first character ---------------------------------------------------- */

static const char *blank(const char *at)
{
    while (*at == ' ' || *at == ',' || *at == ':')
        at++;
    return at;
}

/* The end of a value. */
static const char *skip(const char *at)
{
    int depth = 0;
    do {
        at = blank(at);
        if (*at == '"')
            for (at++; *at != '"' && *at != '\0'; at++)
                at += *at == '\\' && at[1] != '\0';
        else if (*at == '{' || *at == '[')
            depth++;
        else if (*at == '}' || *at == ']')
            depth--;
        else
            while (*at != '\0' && strchr(",:}] ", at[1]) == NULL)
                at++;
        if (*at != '\0')
            at++;
    } while (depth > 0 && *at != '\0');
    return at;
}

static int is_text(const char *value, const char *text)
{
    size_t length = strlen(text);
    return value != NULL && *value == '"' && strncmp(value + 1, text, length) == 0 && value[1 + length] == '"';
}

/* The value of a key of an object, or NULL. */
static const char *get(const char *object, const char *key)
{
    if (object == NULL || *object != '{')
        return NULL;
    for (const char *at = blank(object + 1); *at == '"';) {
        const char *value = blank(skip(at));
        if (is_text(at, key))
            return value;
        at = blank(skip(value));
    }
    return NULL;
}

static int is_true(const char *value) { return value != NULL && *value == 't'; }

/* The bytes of hex digits, put behind those that there are. */
static size_t add_hex(const char *value, size_t size)
{
    unsigned byte;
    for (value++; sscanf(value, "%2x", &byte) == 1 && *value != '"'; value += 2)
        bytes[size++] = (uint8_t)byte;
    return size;
}

/* A string without its escapes, which only quotes and backslashes have here. */
static size_t copy_text(const char *value, char *text, size_t size)
{
    size_t length = 0;
    for (value++; *value != '"' && *value != '\0' && length + 1 < size; value++) {
        unsigned code;
        if (*value == '\\' && value[1] == 'u' && sscanf(value + 2, "%4x", &code) == 1)
            text[length++] = (char)(code < 0x80 ? code : 0x7F), value += 5;
        else
            text[length++] = *value == '\\' ? *++value : *value;
    }
    text[length] = '\0';
    return length;
}

static unsigned find_name(const char *const *names, size_t count, const char *value)
{
    for (unsigned at = 0; at < count; at++)
        if (is_text(value, names[at]))
            return at;
    has_crashed = 1;
    return 0;
}

static i7000_profile profile_of(const char *record)
{
    static const char *const FORMATS[] = {"engineering", "percent", "hex"};
    i7000_profile profile = {.firmware = I7000_NEWEST};
    char letter;
    unsigned major, minor;
    if (get(record, "model") == NULL)
        return profile;
    while (profile.model < I7000_MODELS_SIZE && !is_text(get(record, "model"), i7000_models[profile.model].name))
        profile.model++;
    if (sscanf(get(record, "firmware"), "\"%c%u.%u", &letter, &major, &minor) == 3)
        profile.firmware = I7000_FIRMWARE(letter, major, minor);
    profile.data_format = (uint8_t)find_name(FORMATS, 3, get(record, "data_format"));
    profile.has_checksum = (uint8_t)is_true(get(record, "checksum"));
    profile.is_single_ended = (uint8_t)is_true(get(record, "single_ended"));
    for (const char *at = blank(get(record, "type_codes") + 1); *at != ']'; at = blank(skip(at)))
        profile.types[profile.channels++] = (uint8_t)strtol(at, NULL, 10);
    return profile;
}

/* How many bits a text has, or how many words a list. */
static int32_t count_of(const char *value)
{
    int32_t count = 0;
    if (*value == '"')
        return (int32_t)(skip(value) - value - 2);
    for (const char *item = blank(value + 1); *item != ']'; item = blank(skip(item)))
        count++;
    return count;
}

/* The message that was sent: its numbers, and how many values it has. */
static codec_message message_of(const char *record, const char *const *names, size_t count)
{
    codec_message message = {.message = (uint8_t)find_name(names, count, get(record, "type"))};
    for (const char *at = blank(get(record, "fields") + 1); *at == '"';) {
        const char *value = blank(skip(at));
        codec_field *field = &message.fields[message.count++];
        field->field = (uint8_t)find_name(i7000_field_names, I7000_FIELD_NAMES_SIZE, at);
        field->number = *value == 't' ? 1 : (int32_t)strtol(value, NULL, 10);
        if (field->field == I7000_FIELD_VALUES) {
            field->field = I7000_FIELD_COUNT;
            field->number = count_of(value);
        }
        at = blank(skip(value));
    }
    return message;
}

/* --- writing answers ---------------------------------------------------------------------------------------------- */

static void put_hex(const uint8_t *data, size_t size)
{
    putchar('"');
    while (size-- > 0)
        printf("%02x", *data++);
    putchar('"');
}

static void put_text(const uint8_t *text, size_t length)
{
    putchar('"');
    for (; length > 0; length--, text++)
        printf(*text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
    putchar('"');
}

static void put_texts(const i7000_profile *profile, const uint8_t *text, size_t length, int is_hex)
{
    int is_old = codec_is_old(profile);
    putchar('[');
    for (size_t at = 0, step; at < length; at += step) {
        step = codec_next_field(text + at, length - at, is_hex, is_old);
        printf(at > 0 ? "," : "");
        put_text(text + at, step);
    }
    putchar(']');
}

static void put_field(const codec_message *message, const codec_field *it, const i7000_profile *profile)
{
    printf("\"%s\":", i7000_field_names[it->field]);
    switch (it->kind) {
    case CODEC_BOOLEAN:
        printf(it->number ? "true" : "false");
        break;
    case CODEC_TENTHS:
        printf("%.17g", it->number / 10.0);
        break;
    case CODEC_TEXT:
        put_text(it->text, it->length);
        break;
    case CODEC_TEXTS:
        put_texts(profile, it->text, it->length,
                  message->message == I7000_DCON_ANALOG_INPUTS_HEX || profile->data_format == I7000_FORMAT_HEX);
        break;
    case CODEC_NAME:
        printf("\"%08lx\"", (unsigned long)(uint32_t)it->number);
        break;
    case CODEC_BITS:
        putchar('"');
        for (int32_t at = 0; at < it->number; at++)
            putchar((it->text[at / 8] >> at % 8 & 1) != 0 ? '1' : '0');
        putchar('"');
        break;
    case CODEC_WORDS:
        for (int32_t at = 0; at < it->number; at++)
            printf("%c%d", at == 0 ? '[' : ',', it->text[2 * at] << 8 | it->text[2 * at + 1]);
        putchar(']');
        break;
    default:
        printf("%ld", (long)it->number);
    }
}

static void put_error(unsigned fault) { printf("\"error\":{\"fault\":\"%s\"}", i7000_fault_names[fault]); }

static void put_message(unsigned fault, const char *key, const codec_message *message, const char *name,
                        const i7000_profile *profile)
{
    const codec_field *last = &message->fields[message->count - 1];
    int is_first = 1;
    if (fault != I7000_FAULT_NONE) {
        put_error(fault);
        return;
    }
    printf("\"result\":{\"%s\":{\"type\":\"%s\",\"fields\":{", key, name);
    for (size_t at = 0; at < message->count; at++)
        if (message->fields[at].field != I7000_FIELD_COUNT || (last->kind != CODEC_BITS && last->kind != CODEC_WORDS)) {
            printf(is_first ? "" : ",");
            put_field(message, &message->fields[at], profile);
            is_first = 0;
        }
    printf("}}}");
}

static void put_piece(const codec_piece *piece, int *is_first)
{
    if (piece->size == 0)
        return;
    printf(*is_first ? "{" : ",{");
    *is_first = 0;
    printf(piece->fault == I7000_FAULT_NONE ? "\"frame\":" : "\"noise\":");
    put_hex(piece->bytes, piece->size);
    if (piece->fault != I7000_FAULT_NONE)
        printf(",\"fault\":\"%s\"", i7000_fault_names[piece->fault]);
    putchar('}');
}

/* --- operations --------------------------------------------------------------------------------------------------- */

static void split(const char *input)
{
    static codec_splitter splitter;
    int is_first = 1;
    splitter.size = 0;
    printf("\"result\":{\"events\":[");
    for (const char *at = blank(get(input, "pieces") + 1); *at == '"'; at = blank(skip(at))) {
        size_t size = add_hex(at, 0);
        for (size_t place = 0; place < size; place++) {
            codec_piece before, now;
            codec_push(&splitter, bytes[place], is_true(get(input, "checksum")), &before, &now);
            put_piece(&before, &is_first);
            put_piece(&now, &is_first);
        }
    }
    printf("],\"rest\":");
    put_hex(splitter.buffer, splitter.size);
    putchar('}');
}

static void read_field(const char *input, const i7000_profile *profile, int is_lenient)
{
    static const char *const FORMATS[] = {"engineering", "percent", "hex"};
    char text[LINE_SIZE / 64];
    size_t length = copy_text(get(input, "text"), text, sizeof text);
    unsigned type = (unsigned)strtol(get(input, "type_code") + 1, NULL, 16);
    codec_reading reading;
    unsigned fault = codec_read((const uint8_t *)text, length, type, find_name(FORMATS, 3, get(input, "format")),
                                profile->channels > 0 && codec_is_old(profile), is_lenient, &reading);
    if (fault != I7000_FAULT_NONE)
        put_error(fault);
    else if (reading.status == I7000_STATUS_OK)
        printf("\"result\":{\"value\":%.17g,\"status\":\"ok\"}", reading.value);
    else
        printf("\"result\":{\"value\":null,\"status\":\"%s\"}", i7000_status_names[reading.status]);
}

static void run(const char *test)
{
    const char *operation = get(test, "operation"), *input = get(test, "input");
    i7000_profile profile = profile_of(get(test, "profile"));
    codec_message asked, message = {0};
    size_t size = get(input, "wire") != NULL ? add_hex(get(input, "wire"), 0) : 0;
    unsigned fault;
    if (is_text(operation, "frames.checksum")) {
        size = add_hex(get(input, "body"), 0);
        printf("\"result\":{\"checksum\":\"%02X\"}", codec_checksum(bytes, size));
    } else if (is_text(operation, "frames.crc")) {
        unsigned crc = codec_crc(bytes, add_hex(get(input, "body"), 0));
        printf("\"result\":{\"crc\":\"%02x%02x\"}", crc & 0xFFu, crc >> 8);
    } else if (is_text(operation, "frames.split")) {
        split(input);
    } else if (is_text(operation, "readings.read") || is_text(operation, "readings.read_leniently")) {
        read_field(input, &profile, is_text(operation, "readings.read_leniently"));
    } else if (is_text(operation, "dcon.decode_command")) {
        fault = codec_decode_command(&profile, bytes, size, &message);
        put_message(fault, "command", &message, i7000_dcon_names[message.message], &profile);
    } else if (is_text(operation, "dcon.decode_response")) {
        asked = message_of(get(input, "command"), i7000_dcon_names, I7000_DCON_NAMES_SIZE);
        fault = codec_decode_response(&profile, bytes, size, &asked, &message);
        put_message(fault, "response", &message, i7000_dcon_names[message.message], &profile);
    } else if (is_text(operation, "modbus.decode_request")) {
        fault = codec_decode_request(&profile, bytes, size, &message);
        put_message(fault, "request", &message, i7000_modbus_names[message.message], &profile);
    } else {
        asked = message_of(get(input, "request"), i7000_modbus_names, I7000_MODBUS_NAMES_SIZE);
        fault = codec_decode_modbus_response(&profile, bytes, size, &asked, &message);
        put_message(fault, "response", &message, i7000_modbus_names[message.message], &profile);
    }
}

int main(void)
{
    while (fgets(line, sizeof line, stdin) != NULL) {
        const char *command = get(line, "cmd");
        if (is_text(command, "stop"))
            break;
        printf("{\"seq\":%ld,", strtol(get(line, "seq"), NULL, 10));
        if (is_text(command, "start"))
            printf("\"protocol\":1,\"implementation\":{\"name\":\"c/example\",\"version\":\"1\",\"language\":\"C\"},"
                   "\"operations\":[\"frames.checksum\",\"frames.crc\",\"frames.split\",\"readings.read\","
                   "\"readings.read_leniently\",\"dcon.decode_command\",\"dcon.decode_response\","
                   "\"modbus.decode_request\",\"modbus.decode_response\"]");
        else
            run(get(line, "case"));
        printf(has_crashed ? ",\"crashed\":\"a name that the tables do not have\"}\n" : "}\n");
        has_crashed = 0;
        fflush(stdout);
    }
    return 0;
}
