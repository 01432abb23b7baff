/* The I-7000 and M-7000 analog input modules as constants and tables: DCON, Modbus RTU, readings, register maps.
 *
 * Generated from spec/ by `python -m c.generate`. Do not edit. License: MIT.
 *
 * C99 or later. Include it wherever you need constants or tables. In exactly one source file of your program, write
 *
 *     #define I7000_DEFINE_TABLES
 *     #include "i7000.h"
 *
 * and the tables are defined there. Compile that file with -fdata-sections and link with --gc-sections, and tables that
 * you do not use take no memory, apart from their names. Nothing here allocates. Only two inline functions are code.
 *
 * Sections (2.10) are those of the vendor manual, revision B3.6. spec/README.md and its pages explain the words.
 */
#ifndef I7000_H
#define I7000_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A firmware version as a number: versions compare as these numbers do. B2.10 comes after B2.9. */
#define I7000_FIRMWARE(letter, major, minor) \
    ((uint32_t)(letter) << 16 | (uint32_t)(major) << 8 | (uint32_t)(minor))
#define I7000_ANY 0u            /* any firmware */
#define I7000_NEVER 0xFFFFFFFFu /* no firmware; as an upper limit: no limit */
#define I7000_NEWEST 0xFFFFFFFEu /* of a module whose firmware is unknown */

#define I7000_NO_MINIMUM INT32_MIN
#define I7000_NO_MAXIMUM INT32_MAX
#define I7000_NO_MESSAGE 0xFF
#define I7000_NO_TYPE 0xFF
#define I7000_NO_SUB_FUNCTION 0xFF

/* Special characters of DCON. */
#define I7000_COMMAND_LEADERS "%#$~@"
#define I7000_RESPONSE_LEADERS "!>?"
#define I7000_FRAME_SIZE 256 /* the longest frame, CR or CRC included, of either protocol */

/* @enums */

/* Status of a reading. */
enum {
    I7000_STATUS_OK = 0,
    I7000_STATUS_OVER_RANGE = 1,
    I7000_STATUS_UNDER_RANGE = 2,
    I7000_STATUS_DISABLED = 3, /* the channel is switched off */
};

/* Data formats. */
enum {
    I7000_FORMAT_ENGINEERING = 0, /* of DCON, as in bits 1:0 of FF */
    I7000_FORMAT_PERCENT = 1,
    I7000_FORMAT_HEX = 2,
    I7000_FORMAT_MODBUS_ENGINEERING = 3, /* of registers */
    I7000_FORMAT_MODBUS_HEX = 4,
};

enum {
    I7000_UNIT_MV = 0,
    I7000_UNIT_V = 1,
    I7000_UNIT_MA = 2,
    I7000_UNIT_DEGC = 3,
};

/* What the characters of a part of a body are. */
enum {
    I7000_KIND_LITERAL = 0,    /* those of the notation */
    I7000_KIND_HEX = 1,        /* upper-case hex digits */
    I7000_KIND_BOOL = 2,       /* 0 or 1; anything else has the fault VALUE */
    I7000_KIND_CODE = 3,       /* a digit from 0 to maximum; anything else has the fault VALUE */
    I7000_KIND_SIGNED_HEX = 4, /* a sign and four upper-case hex digits */
    I7000_KIND_DECIMAL = 5,    /* a sign and five digits, a point before the last */
    I7000_KIND_NAME = 6,       /* 20h to 7Eh without the eight leading characters */
    I7000_KIND_VERSION = 7,    /* the same; a letter, a digit, a point, one or two digits */
    I7000_KIND_READING = 8,    /* the field of one channel */
    I7000_KIND_READINGS = 9,   /* the fields of all channels */
};

/* What decides how many characters a part has. */
enum {
    I7000_WIDTH_FIXED = 0,          /* nothing: `digits`; of READINGS, so many a channel */
    I7000_WIDTH_MASK_DIGITS = 1,    /* the model and single-ended inputs: mask_digits... */
    I7000_WIDTH_CHANNEL_DIGITS = 2, /* most_digits with single-ended inputs by command, else `digits` */
    I7000_WIDTH_READING_DIGITS = 3, /* `digits` a channel in hex, else most_digits */
    I7000_WIDTH_LENGTH = 4,         /* any number from `digits` to most_digits */
};

/* What the bytes of a token are. */
enum {
    I7000_TOKEN_LITERAL = 0,   /* `value` */
    I7000_TOKEN_UNSIGNED = 1,  /* a number, high byte first */
    I7000_TOKEN_SIGNED = 2,    /* the same in two's complement */
    I7000_TOKEN_BOOL = 3,      /* 0 or 1 */
    I7000_TOKEN_CODE = 4,      /* 0 to maximum */
    I7000_TOKEN_COIL = 5,      /* FF00 is 1, 0000 is 0 */
    I7000_TOKEN_DIGITS = 6,    /* hex digits, two a byte */
    I7000_TOKEN_MASK = 7,      /* (channels + 7) / 8 bytes */
    I7000_TOKEN_BYTES = 8,     /* how many bytes follow */
    I7000_TOKEN_BITS = 9,      /* count / 8 bytes, rounded up; the first bit is bit 0 of the first byte */
    I7000_TOKEN_WORDS = 10,    /* count words */
    I7000_TOKEN_FUNCTION = 11, /* the function of the request with bit 7 set */
};

/* Areas of a map: function 01, 02, 04 and 03 read them. */
enum {
    I7000_AREA_COIL = 0,
    I7000_AREA_DISCRETE_INPUT = 1,
    I7000_AREA_INPUT_REGISTER = 2,
    I7000_AREA_HOLDING_REGISTER = 3,
};

enum {
    I7000_READ = 1,
    I7000_WRITE = 2,
};

/* How to take the bits or words of a row. */
enum {
    I7000_REGISTER_BOOL = 0,
    I7000_REGISTER_READING = 1, /* in the Modbus data format, with the type of its channel */
    I7000_REGISTER_UINT16 = 2,
    I7000_REGISTER_INT16 = 3,
    I7000_REGISTER_INT8 = 4,   /* in the low byte; the high byte is 00 */
    I7000_REGISTER_UINT32 = 5, /* two registers, the low word first */
    I7000_REGISTER_CODE = 6,   /* one of a list */
    I7000_REGISTER_BITS = 7,
    I7000_REGISTER_RECORD = 8, /* 18 registers: 16 readings, then the time as uint32 */
};

/* --- readings ----------------------------------------------------------------------------------------------------- */

/* A type code: what a channel measures. Row i7000_types[n] is type code n.
 * minimum, maximum and max are in the last digit of an engineering field: 10^-decimals of the unit. */
typedef struct i7000_type {
    const char *name;
    uint8_t unit;            /* I7000_UNIT_... */
    uint8_t decimals;        /* digits behind the point of an engineering field */
    uint8_t is_hex_signed;   /* 0: hex and percent count from minimum to maximum */
    uint8_t is_thermocouple;
    int32_t minimum;
    int32_t maximum;
    int32_t max;             /* the larger absolute value of both: 100 % */
    uint16_t hex_minimum;    /* the words of the ends, as printed */
    uint16_t hex_maximum;
    int16_t modbus_minimum;  /* the same in Modbus engineering format */
    int16_t modbus_maximum;
    uint16_t modbus_counts_per_unit;
    char percent_minimum[8]; /* the fields of the ends, as printed */
    char percent_maximum[8];
} i7000_type;

/* A text or register word in place of a reading. Compare with these before you read a number. */
typedef struct i7000_sentinel {
    uint8_t status;   /* I7000_STATUS_... */
    uint8_t format;   /* I7000_FORMAT_... */
    uint8_t is_legacy; /* only of the I-7018 series up to firmware B1.4 */
    uint32_t types;   /* bit n: for type code n */
    const char *text; /* the whole field; NULL for a register */
    uint16_t word;    /* the register, if there is no text */
} i7000_sentinel;

/* --- models --------------------------------------------------------------------------------------------------------*/

/* These models have it, from this firmware on. */
typedef struct i7000_gate {
    uint32_t models; /* bit n: model n */
    uint32_t firmware;
} i7000_gate;

typedef struct i7000_model {
    const char *name;
    uint16_t series; /* 7017, 7018 or 7019 */
    uint8_t has_modbus;
    uint8_t channels;
    uint8_t single_ended_channels; /* channels, if there are no others */
    uint8_t is_single_ended_by_command;
    uint8_t mask_digits;
    uint8_t mask_digits_single_ended;
    uint8_t default_type; /* I7000_NO_TYPE: the manual names none */
    uint8_t uses_tt; /* TT of %AANNTTCCFF sets the type of all channels */
    uint8_t has_cjc;
    uint8_t has_open_wire_detection;
    uint8_t has_fast_mode;
    uint32_t types;       /* bit n: type code n */
    uint32_t later_types; /* those of them that older firmware does not have */
    uint32_t later_types_from;
    uint32_t individual_types_from; /* firmware from which each channel has a type of its own */
    uint32_t filter_from;
    uint32_t character_formats_from;
} i7000_model;

/* Whether a module has something: its gates, its model and its firmware, I7000_NEWEST if that is unknown. */
static inline int i7000_has(const i7000_gate *gates, size_t count, unsigned model, uint32_t firmware)
{
    for (size_t at = 0; at < count; at++)
        if ((gates[at].models >> model & 1u) != 0 && firmware >= gates[at].firmware)
            return 1;
    return 0;
}

/* What you must know about a module to read its bytes. */
typedef struct i7000_profile {
    uint8_t model;         /* I7000_MODEL_... */
    uint8_t data_format;   /* I7000_FORMAT_..., of DCON */
    uint8_t modbus_format; /* I7000_FORMAT_MODBUS_... */
    uint8_t has_checksum;
    uint8_t is_single_ended;
    uint8_t channels;
    uint32_t firmware; /* I7000_NEWEST if unknown */
    uint8_t types[20]; /* of the channels */
} i7000_profile;

/* --- DCON --------------------------------------------------------------------------------------------------------- */

/* A part of a body: literal characters, or a field. A body is its parts, one behind the other. */
typedef struct i7000_part {
    const char *notation; /* the literal characters, or the letters of the manual for the field */
    uint8_t field;        /* I7000_FIELD_...; NONE of literal characters */
    uint8_t kind;         /* I7000_KIND_... */
    uint8_t width;        /* I7000_WIDTH_...: what decides between the two numbers of digits */
    uint8_t digits;       /* characters, at least */
    uint8_t most_digits;  /* characters, at most */
    int32_t minimum;      /* a host sends no other value; a decoder takes them */
    int32_t maximum;
} i7000_part;

typedef struct i7000_dcon_command {
    const char *name;
    const char *section;
    const char *syntax;          /* the body of the command, in the notation of the manual */
    const char *response_syntax; /* NULL: no module answers */
    uint8_t response;            /* I7000_DCON_...; I7000_NO_MESSAGE */
    const i7000_part *parts;
    size_t part_count;
    const i7000_part *response_parts;
    size_t response_part_count;
    const i7000_gate *gates;
    size_t gate_count;
    uint16_t pause_ms;           /* pause after the command, for firmware from pause_from to pause_to */
    uint8_t pause_is_until_done; /* 1: the module works so long. 0: a gap on the bus, for every module */
    uint32_t pause_from;
    uint32_t pause_to;
} i7000_dcon_command;

/* --- Modbus RTU --------------------------------------------------------------------------------------------------- */

/* A token of a PDU. */
typedef struct i7000_token {
    uint8_t kind;  /* I7000_TOKEN_... */
    uint8_t bytes; /* 0: see the kind */
    uint8_t value; /* of a literal byte */
    uint8_t field; /* I7000_FIELD_... */
    int32_t minimum;
    int32_t maximum;
} i7000_token;

/* A function, or a sub-function of function 46h, with its PDUs. */
typedef struct i7000_modbus_request {
    const char *name;
    const char *section;
    uint8_t function;
    uint8_t sub_function; /* I7000_NO_SUB_FUNCTION */
    uint8_t is_broadcast; /* may go to address 0 */
    uint16_t minimum_count; /* 0: has no count */
    uint16_t maximum_count;
    uint8_t response_message; /* I7000_MODBUS_... */
    const char *request;
    const char *response;
    const i7000_token *tokens;
    size_t token_count;
    const i7000_token *response_tokens;
    size_t response_token_count;
    const i7000_gate *gates;
    size_t gate_count;
} i7000_modbus_request;

/* What a number of a register means. */
typedef struct i7000_value {
    uint16_t number;
    const char *meaning;
} i7000_value;

/* A row of a map. */
typedef struct i7000_register {
    const char *name;
    const char *unit;         /* NULL: none */
    uint16_t counts_per_unit; /* value in unit = number / counts_per_unit; 0: the number is not a quantity */
    uint16_t number;          /* as printed, without leading zeros: 40485, 257 */
    uint16_t address;         /* in frames */
    uint8_t count;            /* coils, inputs or registers */
    uint8_t area;             /* I7000_AREA_... */
    uint8_t access;           /* I7000_READ, I7000_WRITE */
    uint8_t type;             /* I7000_REGISTER_... */
    int32_t minimum;
    int32_t maximum;
    const i7000_value *values;
    size_t value_count;
    uint32_t models; /* of the map's, those that have the row; bit n: model n */
    uint32_t firmware; /* from which on they have it */
} i7000_register;

typedef struct i7000_map {
    const char *section;
    uint32_t models;
    uint32_t firmware; /* from which on they have the map; functions 04 and 02 are older */
    uint16_t maximum_write_count; /* registers in one write; 0: 123 */
    const i7000_register *rows;
    size_t row_count;
} i7000_map;

/* The register at an address in frames that a module has, or NULL. */
static inline const i7000_register *i7000_find_register(const i7000_map *map, unsigned area, unsigned address,
                                                        unsigned model, uint32_t firmware)
{
    for (size_t at = 0; at < map->row_count; at++) {
        const i7000_register *row = &map->rows[at];
        if (row->area == area && address >= row->address && address - row->address < row->count &&
            (row->models >> model & 1u) != 0 && firmware >= row->firmware)
            return row;
    }
    return NULL;
}

/* --- tables ------------------------------------------------------------------------------------------------------- */

/* @externs */

#ifdef I7000_DEFINE_TABLES

/* @tables */

#endif /* I7000_DEFINE_TABLES */

#ifdef __cplusplus
}
#endif

#endif /* I7000_H */
