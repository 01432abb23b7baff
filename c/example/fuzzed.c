/* The decoder of the example for the harness c/i7000_fuzz.c. */
#include "../i7000_vectors.h"
#include "common.h"

int i7000_fuzz_decode(const i7000_exchange *vector, int is_modbus, int is_response, const uint8_t *frame, size_t size);

/* The command of a vector as this decoder has it. */
static codec_message message_of(const i7000_vector_message *sent)
{
    codec_message message = {.message = sent->message};
    for (size_t at = 0; at < sent->field_count; at++) {
        const i7000_vector_field *it = &sent->fields[at];
        int is_list = it->words != NULL;
        codec_add(&message, is_list ? I7000_FIELD_COUNT : it->field, CODEC_NUMBER,
                  is_list ? (int32_t)it->count : it->number, NULL, 0);
    }
    return message;
}

int i7000_fuzz_decode(const i7000_exchange *vector, int is_modbus, int is_response, const uint8_t *frame, size_t size)
{
    codec_message found, sent;
    if (!is_response)
        return (int)(is_modbus ? codec_decode_request(vector->profile, frame, size, &found)
                               : codec_decode_command(vector->profile, frame, size, &found));
    sent = message_of(vector->command_message);
    return (int)(is_modbus ? codec_decode_modbus_response(vector->profile, frame, size, &sent, &found)
                           : codec_decode_response(vector->profile, frame, size, &sent, &found));
}
