/* Fuzzes your decoder: frames of the vectors of spec/, changed at a few places, most of them with the right checksum or
 * CRC, so that they get past it.
 *
 * Generated from spec/ by `python -m c.generate`. Do not edit. License: MIT.
 *
 * Write i7000_fuzz_decode (c/example/fuzzed.c is one), and link it with this file and your decoder:
 *
 *     clang -g -O1 -fsanitize=fuzzer,address,undefined i7000_fuzz.c fuzzed.c decoder.c -o fuzz && ./fuzz
 *
 * Without libFuzzer, the same from a random seed; gcc takes it too:
 *
 *     gcc -g -O1 -fsanitize=address,undefined -DI7000_FUZZ_MAIN i7000_fuzz.c fuzzed.c decoder.c -o fuzz
 *     ./fuzz 1000000 7
 *
 * An input is two bytes for the vector that gives the context, one byte whose lowest bit says that a response follows,
 * and the frame.
 */
#define I7000_DEFINE_TABLES
#define I7000_VECTORS_DCON
#define I7000_VECTORS_MODBUS
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "i7000_vectors.h"

/* Your decoder: decode a frame, and return I7000_FAULT_..., NONE if it is accepted. The vector has the profile; if
 * is_response, its command_message is what was sent. Return -1 for what you do not implement. */
int i7000_fuzz_decode(const i7000_exchange *vector, int is_modbus, int is_response, const uint8_t *frame, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t room, unsigned seed);

#define HEAD 3

/* The characters of the syntaxes of DCON, and digits. */
static const char LETTERS[] = "\r !#$%*+-.0123456789>\?@ABCDEFIMNOPRSTVaeimnrt~";

static const i7000_exchange *find_vector(const uint8_t *data, int *is_modbus)
{
    size_t count = 0, place = (size_t)data[0] << 8 | data[1];
    for (const i7000_exchange_section *it = i7000_exchange_sections; it->vectors != NULL; it++)
        count += it->count;
    place %= count;
    for (const i7000_exchange_section *it = i7000_exchange_sections;; it++) {
        if (place < it->count) {
            *is_modbus = it->is_modbus;
            return &it->vectors[place];
        }
        place -= it->count;
    }
}

/* Whether a frame of this vector can be a response. */
static int is_response_of(const i7000_exchange *vector, const uint8_t *data)
{
    return (data[2] & 1) != 0 && vector->command_message != NULL && vector->outcome != I7000_OUTCOME_SILENCE;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    int is_modbus;
    if (size < HEAD)
        return 0;
    const i7000_exchange *vector = find_vector(data, &is_modbus);
    int is_response = is_response_of(vector, data);
    const uint8_t *own = is_response ? vector->response : vector->command;
    size_t own_size = is_response ? vector->response_size : vector->command_size;
    int fault = i7000_fuzz_decode(vector, is_modbus, is_response, data + HEAD, size - HEAD);
    if (fault != i7000_fuzz_decode(vector, is_modbus, is_response, data + HEAD, size - HEAD)) {
        fprintf(stderr, "%s: the same frame was decoded in two ways\n", vector->id);
        abort();
    }
    /* The frame of the vector itself has a known end: it is rejected as the vector says, or accepted. Where the manual
       says nothing, another reading than that of the vector is not wrong. */
    int is_own = own != NULL && size - HEAD == own_size && memcmp(own, data + HEAD, own_size) == 0;
    if (fault >= 0 && vector->source != I7000_SOURCE_ASSUMED && is_own) {
        int is_rejected = vector->outcome == I7000_OUTCOME_REJECT && is_response == (vector->response != NULL);
        if (fault != (is_rejected ? vector->fault : I7000_FAULT_NONE)) {
            fprintf(stderr, "%s: the %s has fault %d\n", vector->id, is_response ? "response" : "command", fault);
            abort();
        }
    }
    return 0;
}

/* --- changing a frame --------------------------------------------------------------------------------------------- */

static uint32_t random_state;

static unsigned draw(size_t below)
{
    random_state = random_state * 1664525u + 1013904223u;
    return below == 0 ? 0 : (unsigned)((random_state >> 8) % below);
}

/* Put the checksum or the CRC right. */
static void seal(const i7000_exchange *vector, int is_modbus, uint8_t *frame, size_t size)
{
    unsigned sum = 0, crc = 0xFFFF;
    if (is_modbus && size > 2) {
        for (size_t at = 0; at < size - 2; at++) {
            crc ^= frame[at];
            for (int bit = 0; bit < 8; bit++)
                crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xA001u : crc >> 1;
        }
        frame[size - 2] = (uint8_t)crc;
        frame[size - 1] = (uint8_t)(crc >> 8);
    } else if (!is_modbus && size > 0) {
        frame[size - 1] = '\r';
        if (vector->profile->has_checksum && size > 3) {
            for (size_t at = 0; at < size - 3; at++)
                sum += frame[at];
            frame[size - 3] = (uint8_t)"0123456789ABCDEF"[sum >> 4 & 15u];
            frame[size - 2] = (uint8_t)"0123456789ABCDEF"[sum & 15u];
        }
    }
}

/* Change, drop or add one byte. */
static size_t change(uint8_t *frame, size_t size, size_t room)
{
    size_t at = draw(size + 1);
    uint8_t byte = (uint8_t)(draw(4) == 0 ? draw(256) : (unsigned char)LETTERS[draw(sizeof LETTERS - 1)]);
    unsigned kind = draw(4);
    if (kind == 0 && size < room) {
        memmove(frame + at + 1, frame + at, size - at);
        frame[at] = byte;
        return size + 1;
    }
    if (kind == 1 && at < size) {
        memmove(frame + at, frame + at + 1, size - at - 1);
        return size - 1;
    }
    if (at < size)
        frame[at] = byte;
    return size;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t room, unsigned seed)
{
    int is_modbus;
    random_state = seed;
    if (room < HEAD)
        return size;
    if (size < HEAD || draw(8) == 0) {
        data[0] = (uint8_t)draw(256), data[1] = (uint8_t)draw(256), data[2] = (uint8_t)draw(256);
        const i7000_exchange *vector = find_vector(data, &is_modbus);
        int is_response = is_response_of(vector, data) && vector->response != NULL;
        size = is_response ? vector->response_size : vector->command_size;
        if (size > room - HEAD)
            size = room - HEAD;
        if (size > 0)
            memcpy(data + HEAD, is_response ? vector->response : vector->command, size);
        if (draw(8) == 0)
            return size + HEAD;
    } else {
        size -= HEAD;
    }
    const i7000_exchange *vector = find_vector(data, &is_modbus);
    for (unsigned changes = draw(4); changes > 0; changes--)
        size = change(data + HEAD, size, room - HEAD);
    if (draw(8) != 0)
        seal(vector, is_modbus, data + HEAD, size);
    return size + HEAD;
}

#ifdef I7000_FUZZ_MAIN
int main(int count, char **arguments)
{
    static uint8_t data[2 * I7000_FRAME_SIZE];
    unsigned long runs = count > 1 ? strtoul(arguments[1], NULL, 10) : 1000000;
    unsigned seed = count > 2 ? (unsigned)strtoul(arguments[2], NULL, 10) : 0;
    size_t size = 0;
    for (unsigned long run = 0; run < runs; run++) {
        size = LLVMFuzzerCustomMutator(data, size, sizeof data, seed + (unsigned)run * 2654435761u);
        uint8_t *exact = malloc(size); /* so that AddressSanitizer sees a read behind its end */
        if (exact == NULL)
            return 1;
        memcpy(exact, data, size);
        LLVMFuzzerTestOneInput(exact, size);
        free(exact);
    }
    printf("%lu frames, no finding\n", runs);
    return 0;
}
#endif
