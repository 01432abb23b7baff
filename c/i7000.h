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


/* Type codes. */
enum {
    I7000_TYPE_MV_15 = 0,
    I7000_TYPE_MV_50 = 1,
    I7000_TYPE_MV_100 = 2,
    I7000_TYPE_MV_500_03 = 3,
    I7000_TYPE_V_1_04 = 4,
    I7000_TYPE_V_2_5 = 5,
    I7000_TYPE_MA_20_06 = 6,
    I7000_TYPE_MA_4_20 = 7,
    I7000_TYPE_V_10 = 8,
    I7000_TYPE_V_5 = 9,
    I7000_TYPE_V_1_0A = 10,
    I7000_TYPE_MV_500_0B = 11,
    I7000_TYPE_MV_150 = 12,
    I7000_TYPE_MA_20_0D = 13,
    I7000_TYPE_J = 14,
    I7000_TYPE_K = 15,
    I7000_TYPE_T = 16,
    I7000_TYPE_E = 17,
    I7000_TYPE_R = 18,
    I7000_TYPE_S = 19,
    I7000_TYPE_B = 20,
    I7000_TYPE_N = 21,
    I7000_TYPE_C = 22,
    I7000_TYPE_L = 23,
    I7000_TYPE_M = 24,
    I7000_TYPE_L_DIN43710 = 25,
    I7000_TYPE_MA_0_20 = 26,
    I7000_TYPE_V_150 = 27,
    I7000_TYPE_V_50 = 28,
};

/* Models: places in i7000_models, and bits of masks. */
enum {
    I7000_MODEL_I_7017 = 0,
    I7000_MODEL_I_7017F = 1,
    I7000_MODEL_I_7017C = 2,
    I7000_MODEL_I_7017FC = 3,
    I7000_MODEL_I_7017R = 4,
    I7000_MODEL_I_7017RC = 5,
    I7000_MODEL_I_7017R_A5 = 6,
    I7000_MODEL_I_7017Z = 7,
    I7000_MODEL_M_7017 = 8,
    I7000_MODEL_M_7017C = 9,
    I7000_MODEL_M_7017R = 10,
    I7000_MODEL_M_7017RC = 11,
    I7000_MODEL_M_7017R_A5 = 12,
    I7000_MODEL_M_7017Z = 13,
    I7000_MODEL_M_7017RMS = 14,
    I7000_MODEL_M_7017mC_16 = 15,
    I7000_MODEL_I_7018 = 16,
    I7000_MODEL_I_7018P = 17,
    I7000_MODEL_I_7018BL = 18,
    I7000_MODEL_I_7018R = 19,
    I7000_MODEL_I_7018Z = 20,
    I7000_MODEL_M_7018 = 21,
    I7000_MODEL_M_7018R = 22,
    I7000_MODEL_M_7018Z = 23,
    I7000_MODEL_M_7018_16 = 24,
    I7000_MODEL_I_7019R = 25,
    I7000_MODEL_M_7019R = 26,
    I7000_MODEL_M_7019Z = 27,
};

/* Codes of settings, within their bits; limits and defaults. */
enum {
    I7000_SETTING_BAUD_1200 = 3,
    I7000_SETTING_BAUD_2400 = 4,
    I7000_SETTING_BAUD_4800 = 5,
    I7000_SETTING_BAUD_9600 = 6,
    I7000_SETTING_BAUD_19200 = 7,
    I7000_SETTING_BAUD_38400 = 8,
    I7000_SETTING_BAUD_57600 = 9,
    I7000_SETTING_BAUD_115200 = 10,
    I7000_SETTING_N81 = 0,
    I7000_SETTING_N82 = 1,
    I7000_SETTING_E81 = 2,
    I7000_SETTING_O81 = 3,
    I7000_SETTING_ENGINEERING = 0,
    I7000_SETTING_PERCENT = 1,
    I7000_SETTING_HEX = 2,
    I7000_SETTING_MODE_NORMAL = 0,
    I7000_SETTING_MODE_FAST = 1,
    I7000_SETTING_CHECKSUM_DISABLED = 0,
    I7000_SETTING_CHECKSUM_ENABLED = 1,
    I7000_SETTING_REJECT_60_HZ = 0,
    I7000_SETTING_REJECT_50_HZ = 1,
    I7000_SETTING_TYPE_CODE_MIXED = 255,
    I7000_SETTING_CHANNEL_MASK_DISABLED = 0,
    I7000_SETTING_CHANNEL_MASK_ENABLED = 1,
    I7000_SETTING_DIAGNOSTICS_NORMAL = 0,
    I7000_SETTING_DIAGNOSTICS_FAULT = 1,
    I7000_SETTING_SYNCHRONIZED_DATA_REPEATED = 0,
    I7000_SETTING_SYNCHRONIZED_DATA_FIRST = 1,
    I7000_SETTING_STOPPED = 0,
    I7000_SETTING_STARTED = 1,
    I7000_SETTING_ONCE = 2,
    I7000_SETTING_CJC_DISABLED = 0,
    I7000_SETTING_CJC_ENABLED = 1,
    I7000_SETTING_CALIBRATION_DISABLED = 0,
    I7000_SETTING_CALIBRATION_ENABLED = 1,
    I7000_SETTING_OPEN_WIRE_DETECTION_DISABLED = 0,
    I7000_SETTING_OPEN_WIRE_DETECTION_ENABLED = 1,
    I7000_SETTING_CONNECTING_MODE_DIFFERENTIAL = 0,
    I7000_SETTING_CONNECTING_MODE_SINGLE_ENDED = 1,
    I7000_SETTING_PROTOCOLS_SUPPORTED_DCON = 0,
    I7000_SETTING_PROTOCOLS_SUPPORTED_DCON_AND_MODBUS = 1,
    I7000_SETTING_DCON = 0,
    I7000_SETTING_MODBUS_RTU = 1,
    I7000_SETTING_HOST_WATCHDOG_DISABLED = 0,
    I7000_SETTING_HOST_WATCHDOG_ENABLED = 1,
    I7000_SETTING_HOST_WATCHDOG_STATUS_TIMED_OUT = 4,
    I7000_SETTING_HOST_WATCHDOG_STATUS_ENABLED = 128,
    I7000_SETTING_LIMIT_CJC_OFFSET = 4096,
    I7000_SETTING_LIMIT_SOFT_INIT_TIMEOUT = 60,
    I7000_SETTING_LIMIT_HOST_WATCHDOG_TIMEOUT = 255,
    I7000_SETTING_LIMIT_MODULE_NAME = 6,
    I7000_SETTING_DEFAULT_MODULE_ADDRESS = 1,
    I7000_SETTING_DEFAULT_BAUD_RATE = 6,
    I7000_SETTING_DEFAULT_CHECKSUM = 0,
    I7000_SETTING_DEFAULT_DATA_FORMAT = 0,
    I7000_SETTING_DEFAULT_FILTER = 0,
    I7000_SETTING_DEFAULT_PROTOCOL = 1,
    I7000_SETTING_DEFAULT_MODE = 1,
    I7000_SETTING_DEFAULT_SOFT_INIT_TIMEOUT = 0,
    I7000_SETTING_INIT_MODE_MODULE_ADDRESS = 0,
    I7000_SETTING_INIT_MODE_BAUD_RATE = 6,
    I7000_SETTING_INIT_MODE_CHECKSUM = 0,
    I7000_SETTING_INIT_MODE_PROTOCOL = 0,
};

/* Messages of DCON; first the commands, which have the numbers of their rows. */
enum {
    I7000_DCON_SET_CONFIGURATION = 0,
    I7000_DCON_SYNCHRONIZED_SAMPLING = 1,
    I7000_DCON_READ_ANALOG_INPUTS = 2,
    I7000_DCON_READ_ANALOG_INPUT = 3,
    I7000_DCON_CALIBRATE_SPAN = 4,
    I7000_DCON_CALIBRATE_ZERO = 5,
    I7000_DCON_CALIBRATE_CURRENT_CHANNEL_SPAN = 6,
    I7000_DCON_CALIBRATE_CHANNEL_ZERO = 7,
    I7000_DCON_CALIBRATE_CHANNEL_SPAN = 8,
    I7000_DCON_READ_CONFIGURATION = 9,
    I7000_DCON_READ_CJC_TEMPERATURE = 10,
    I7000_DCON_READ_SYNCHRONIZED_DATA = 11,
    I7000_DCON_SET_CHANNEL_MASK = 12,
    I7000_DCON_READ_CHANNEL_MASK = 13,
    I7000_DCON_SET_CHANNEL_TYPE_CODE = 14,
    I7000_DCON_READ_CHANNEL_TYPE_CODE = 15,
    I7000_DCON_READ_CJC_OFFSET = 16,
    I7000_DCON_SET_CJC_OFFSET = 17,
    I7000_DCON_READ_ANALOG_INPUTS_HEX = 18,
    I7000_DCON_READ_CJC_UPDATE = 19,
    I7000_DCON_SET_CJC_UPDATE = 20,
    I7000_DCON_READ_DIAGNOSTICS = 21,
    I7000_DCON_READ_FIRMWARE_VERSION = 22,
    I7000_DCON_READ_MODULE_NAME = 23,
    I7000_DCON_READ_PROTOCOL = 24,
    I7000_DCON_SET_PROTOCOL = 25,
    I7000_DCON_CALIBRATE_INTERNALLY = 26,
    I7000_DCON_RELOAD_DEFAULT_CALIBRATION = 27,
    I7000_DCON_READ_CJC_ENABLED = 28,
    I7000_DCON_SET_CJC_ENABLED = 29,
    I7000_DCON_SET_CALIBRATION_ENABLED = 30,
    I7000_DCON_SOFT_INIT = 31,
    I7000_DCON_SET_MODULE_NAME = 32,
    I7000_DCON_SET_SOFT_INIT_TIMEOUT = 33,
    I7000_DCON_HOST_OK = 34,
    I7000_DCON_READ_HOST_WATCHDOG_STATUS = 35,
    I7000_DCON_RESET_HOST_WATCHDOG_STATUS = 36,
    I7000_DCON_READ_HOST_WATCHDOG_TIMEOUT = 37,
    I7000_DCON_SET_HOST_WATCHDOG_TIMEOUT = 38,
    I7000_DCON_READ_OPEN_WIRE_DETECTION = 39,
    I7000_DCON_SET_OPEN_WIRE_DETECTION = 40,
    I7000_DCON_READ_CONNECTING_MODE = 41,
    I7000_DCON_SET_CONNECTING_MODE = 42,
    I7000_DCON_ACKNOWLEDGED = 43,
    I7000_DCON_ANALOG_INPUTS = 44,
    I7000_DCON_ANALOG_INPUT = 45,
    I7000_DCON_CONFIGURATION = 46,
    I7000_DCON_CJC_TEMPERATURE = 47,
    I7000_DCON_SYNCHRONIZED_DATA = 48,
    I7000_DCON_CHANNEL_MASK = 49,
    I7000_DCON_CHANNEL_TYPE_CODE = 50,
    I7000_DCON_CJC_OFFSET = 51,
    I7000_DCON_ANALOG_INPUTS_HEX = 52,
    I7000_DCON_CJC_UPDATE_SETTING = 53,
    I7000_DCON_DIAGNOSTICS = 54,
    I7000_DCON_FIRMWARE_VERSION = 55,
    I7000_DCON_MODULE_NAME = 56,
    I7000_DCON_PROTOCOL_SETTING = 57,
    I7000_DCON_CJC_ENABLED = 58,
    I7000_DCON_HOST_WATCHDOG_STATUS = 59,
    I7000_DCON_HOST_WATCHDOG_TIMEOUT = 60,
    I7000_DCON_OPEN_WIRE_DETECTION = 61,
    I7000_DCON_CONNECTING_MODE = 62,
    I7000_DCON_REFUSED = 63,
};

/* Messages of Modbus; first the functions, then the sub-functions. */
enum {
    I7000_MODBUS_READ_COILS = 0,
    I7000_MODBUS_READ_DISCRETE_INPUTS = 1,
    I7000_MODBUS_READ_HOLDING_REGISTERS = 2,
    I7000_MODBUS_READ_INPUT_REGISTERS = 3,
    I7000_MODBUS_WRITE_SINGLE_COIL = 4,
    I7000_MODBUS_WRITE_SINGLE_REGISTER = 5,
    I7000_MODBUS_WRITE_MULTIPLE_COILS = 6,
    I7000_MODBUS_WRITE_MULTIPLE_REGISTERS = 7,
    I7000_MODBUS_READ_MODULE_NAME = 8,
    I7000_MODBUS_SET_MODULE_ADDRESS = 9,
    I7000_MODBUS_READ_COMMUNICATION_SETTINGS = 10,
    I7000_MODBUS_SET_COMMUNICATION_SETTINGS = 11,
    I7000_MODBUS_READ_TYPE_CODE = 12,
    I7000_MODBUS_SET_TYPE_CODE = 13,
    I7000_MODBUS_READ_FIRMWARE_VERSION = 14,
    I7000_MODBUS_READ_CHANNEL_MASK = 15,
    I7000_MODBUS_SET_CHANNEL_MASK = 16,
    I7000_MODBUS_READ_MISCELLANEOUS_SETTINGS = 17,
    I7000_MODBUS_SET_MISCELLANEOUS_SETTINGS = 18,
    I7000_MODBUS_READ_CJC_OFFSET = 19,
    I7000_MODBUS_SET_CJC_OFFSET = 20,
    I7000_MODBUS_READ_CJC_ENABLED = 21,
    I7000_MODBUS_SET_CJC_ENABLED = 22,
    I7000_MODBUS_READ_CJC_UPDATE = 23,
    I7000_MODBUS_SET_CJC_UPDATE = 24,
    I7000_MODBUS_COILS = 25,
    I7000_MODBUS_DISCRETE_INPUTS = 26,
    I7000_MODBUS_HOLDING_REGISTERS = 27,
    I7000_MODBUS_INPUT_REGISTERS = 28,
    I7000_MODBUS_SINGLE_COIL_WRITTEN = 29,
    I7000_MODBUS_SINGLE_REGISTER_WRITTEN = 30,
    I7000_MODBUS_MULTIPLE_COILS_WRITTEN = 31,
    I7000_MODBUS_MULTIPLE_REGISTERS_WRITTEN = 32,
    I7000_MODBUS_MODULE_NAME = 33,
    I7000_MODBUS_MODULE_ADDRESS_RESULT = 34,
    I7000_MODBUS_COMMUNICATION_SETTINGS = 35,
    I7000_MODBUS_COMMUNICATION_SETTINGS_RESULT = 36,
    I7000_MODBUS_TYPE_CODE_SETTING = 37,
    I7000_MODBUS_TYPE_CODE_RESULT = 38,
    I7000_MODBUS_FIRMWARE_VERSION = 39,
    I7000_MODBUS_CHANNEL_MASK = 40,
    I7000_MODBUS_CHANNEL_MASK_RESULT = 41,
    I7000_MODBUS_MISCELLANEOUS_SETTINGS = 42,
    I7000_MODBUS_MISCELLANEOUS_SETTINGS_RESULT = 43,
    I7000_MODBUS_CJC_OFFSET = 44,
    I7000_MODBUS_CJC_OFFSET_RESULT = 45,
    I7000_MODBUS_CJC_ENABLED = 46,
    I7000_MODBUS_CJC_ENABLED_RESULT = 47,
    I7000_MODBUS_CJC_UPDATE_SETTING = 48,
    I7000_MODBUS_CJC_UPDATE_RESULT = 49,
    I7000_MODBUS_EXCEPTION_RESPONSE = 50,
};

/* Fields of messages. */
enum {
    I7000_FIELD_NONE = 0,
    I7000_FIELD_ADDRESS = 1,
    I7000_FIELD_BUILD = 2,
    I7000_FIELD_CHANNEL = 3,
    I7000_FIELD_COIL = 4,
    I7000_FIELD_COUNT = 5,
    I7000_FIELD_ENABLED = 6,
    I7000_FIELD_EXCEPTION_CODE = 7,
    I7000_FIELD_FIRST_READING = 8,
    I7000_FIELD_FUNCTION = 9,
    I7000_FIELD_LINE_RESULT = 10,
    I7000_FIELD_LINE_SETTINGS = 11,
    I7000_FIELD_MAJOR = 12,
    I7000_FIELD_MASK = 13,
    I7000_FIELD_MINOR = 14,
    I7000_FIELD_MODBUS_SUPPORTED = 15,
    I7000_FIELD_NAME = 16,
    I7000_FIELD_NEW_ADDRESS = 17,
    I7000_FIELD_OFFSET = 18,
    I7000_FIELD_PROTOCOL = 19,
    I7000_FIELD_PROTOCOL_RESULT = 20,
    I7000_FIELD_REGISTER = 21,
    I7000_FIELD_REPORT_SETTINGS = 22,
    I7000_FIELD_RESULT = 23,
    I7000_FIELD_SETTINGS = 24,
    I7000_FIELD_SINGLE_ENDED = 25,
    I7000_FIELD_START = 26,
    I7000_FIELD_STATUS = 27,
    I7000_FIELD_TEMPERATURE = 28,
    I7000_FIELD_TIMEOUT = 29,
    I7000_FIELD_TYPE_CODE = 30,
    I7000_FIELD_UPDATE = 31,
    I7000_FIELD_VALUE = 32,
    I7000_FIELD_VALUES = 33,
    I7000_FIELD_VERSION = 34,
};

/* Why bytes are rejected; spec/dcon.md and spec/modbus.md say when. */
enum {
    I7000_FAULT_NONE = 0,
    I7000_FAULT_LENGTH = 1,
    I7000_FAULT_TERMINATOR = 2,
    I7000_FAULT_CHARACTER = 3,
    I7000_FAULT_LEADING = 4,
    I7000_FAULT_CHECKSUM = 5,
    I7000_FAULT_COMMAND = 6,
    I7000_FAULT_UNSUPPORTED = 7,
    I7000_FAULT_ADDRESS = 8,
    I7000_FAULT_NUMBER = 9,
    I7000_FAULT_VALUE = 10,
    I7000_FAULT_CRC = 11,
    I7000_FAULT_FUNCTION = 12,
    I7000_FAULT_SUB_FUNCTION = 13,
    I7000_FAULT_COUNT = 14,
    I7000_FAULT_ECHO = 15,
    I7000_FAULT_RESERVED = 16,
    I7000_FAULT_RANGE = 17,
};

/* Sizes of the arrays. */
enum {
    I7000_TYPES_SIZE = 29,
    I7000_SENTINELS_SIZE = 27,
    I7000_MODELS_SIZE = 28,
    I7000_DCON_COMMANDS_SIZE = 43,
    I7000_MODBUS_FUNCTIONS_SIZE = 8,
    I7000_MODULE_SETTINGS_SIZE = 17,
    I7000_MAPS_SIZE = 9,
    I7000_FAULT_NAMES_SIZE = 18,
    I7000_FIELD_NAMES_SIZE = 35,
    I7000_DCON_NAMES_SIZE = 64,
    I7000_MODBUS_NAMES_SIZE = 51,
    I7000_STATUS_NAMES_SIZE = 4,
    I7000_UNIT_NAMES_SIZE = 4,
};

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

extern const i7000_type i7000_types[29];
extern const i7000_sentinel i7000_sentinels[27];
extern const i7000_model i7000_models[28];
extern const i7000_dcon_command i7000_dcon_commands[43];
extern const i7000_modbus_request i7000_modbus_functions[8];
extern const i7000_modbus_request i7000_module_settings[17];
extern const i7000_map i7000_maps[9];
extern const char *const i7000_fault_names[18];
extern const char *const i7000_field_names[35];
extern const char *const i7000_dcon_names[64];
extern const char *const i7000_modbus_names[51];
extern const char *const i7000_status_names[4];
extern const char *const i7000_unit_names[4];

#ifdef I7000_DEFINE_TABLES

const i7000_type i7000_types[29] = {
    {
        "+/-15 mV", I7000_UNIT_MV, 3, 1, 0, -15000, 15000, 15000, 0x8000, 0x7FFF, -15000, 15000, 1000, "-100.00",
        "+100.00",
    },
    {"+/-50 mV", I7000_UNIT_MV, 3, 1, 0, -50000, 50000, 50000, 0x8000, 0x7FFF, -5000, 5000, 100, "-100.00", "+100.00"},
    {
        "+/-100 mV", I7000_UNIT_MV, 2, 1, 0, -10000, 10000, 10000, 0x8000, 0x7FFF, -10000, 10000, 100, "-100.00",
        "+100.00",
    },
    {"+/-500 mV", I7000_UNIT_MV, 2, 1, 0, -50000, 50000, 50000, 0x8000, 0x7FFF, -5000, 5000, 10, "-100.00", "+100.00"},
    {"+/-1 V", I7000_UNIT_V, 4, 1, 0, -10000, 10000, 10000, 0x8000, 0x7FFF, -10000, 10000, 10000, "-100.00", "+100.00"},
    {
        "+/-2.5 V", I7000_UNIT_V, 4, 1, 0, -25000, 25000, 25000, 0x8000, 0x7FFF, -25000, 25000, 10000, "-100.00",
        "+100.00",
    },
    {
        "+/-20 mA", I7000_UNIT_MA, 3, 1, 0, -20000, 20000, 20000, 0x8000, 0x7FFF, -20000, 20000, 1000, "-100.00",
        "+100.00",
    },
    {
        "+4 to +20 mA", I7000_UNIT_MA, 3, 0, 0, 4000, 20000, 20000, 0x0000, 0xFFFF, 4000, 20000, 1000, "+000.00",
        "+100.00",
    },
    {"+/-10 V", I7000_UNIT_V, 3, 1, 0, -10000, 10000, 10000, 0x8000, 0x7FFF, -10000, 10000, 1000, "-100.00", "+100.00"},
    {"+/-5 V", I7000_UNIT_V, 4, 1, 0, -50000, 50000, 50000, 0x8000, 0x7FFF, -5000, 5000, 1000, "-100.00", "+100.00"},
    {"+/-1 V", I7000_UNIT_V, 4, 1, 0, -10000, 10000, 10000, 0x8000, 0x7FFF, -10000, 10000, 10000, "-100.00", "+100.00"},
    {"+/-500 mV", I7000_UNIT_MV, 2, 1, 0, -50000, 50000, 50000, 0x8000, 0x7FFF, -5000, 5000, 10, "-100.00", "+100.00"},
    {
        "+/-150 mV", I7000_UNIT_MV, 2, 1, 0, -15000, 15000, 15000, 0x8000, 0x7FFF, -15000, 15000, 100, "-100.00",
        "+100.00",
    },
    {
        "+/-20 mA", I7000_UNIT_MA, 3, 1, 0, -20000, 20000, 20000, 0x8000, 0x7FFF, -20000, 20000, 1000, "-100.00",
        "+100.00",
    },
    {
        "Type J thermocouple", I7000_UNIT_DEGC, 2, 1, 1, -21000, 76000, 76000, 0xDCA2, 0x7FFF, -2100, 7600, 10,
        "-027.63", "+100.00",
    },
    {
        "Type K thermocouple", I7000_UNIT_DEGC, 1, 1, 1, -2700, 13720, 13720, 0xE6D0, 0x7FFF, -2700, 13720, 10,
        "-019.68", "+100.00",
    },
    {
        "Type T thermocouple", I7000_UNIT_DEGC, 2, 1, 1, -27000, 40000, 40000, 0xA99A, 0x7FFF, -2700, 4000, 10,
        "-067.50", "+100.00",
    },
    {
        "Type E thermocouple", I7000_UNIT_DEGC, 1, 1, 1, -2700, 10000, 10000, 0xDD71, 0x7FFF, -2700, 10000, 10,
        "-027.00", "+100.00",
    },
    {
        "Type R thermocouple", I7000_UNIT_DEGC, 1, 1, 1, 0, 17680, 17680, 0x0000, 0x7FFF, 0, 17680, 10, "+000.00",
        "+100.00",
    },
    {
        "Type S thermocouple", I7000_UNIT_DEGC, 1, 1, 1, 0, 17680, 17680, 0x0000, 0x7FFF, 0, 17680, 10, "+000.00",
        "+100.00",
    },
    {
        "Type B thermocouple", I7000_UNIT_DEGC, 1, 1, 1, 0, 18200, 18200, 0x0000, 0x7FFF, 0, 18200, 10, "+000.00",
        "+100.00",
    },
    {
        "Type N thermocouple", I7000_UNIT_DEGC, 1, 1, 1, -2700, 13000, 13000, 0xE56B, 0x7FFF, -2700, 13000, 10,
        "-020.77", "+100.00",
    },
    {
        "Type C thermocouple", I7000_UNIT_DEGC, 1, 1, 1, 0, 23200, 23200, 0x0000, 0x7FFF, 0, 23200, 10, "+000.00",
        "+100.00",
    },
    {
        "Type L thermocouple", I7000_UNIT_DEGC, 2, 1, 1, -20000, 80000, 80000, 0xE000, 0x7FFF, -2000, 8000, 10,
        "-025.00", "+100.00",
    },
    {
        "Type M thermocouple", I7000_UNIT_DEGC, 2, 1, 1, -20000, 10000, 20000, 0x8000, 0x4000, -20000, 10000, 100,
        "-100.00", "+050.00",
    },
    {
        "Type L DIN43710 thermocouple", I7000_UNIT_DEGC, 2, 1, 1, -20000, 90000, 90000, 0xE38E, 0x7FFF, -2000, 9000, 10,
        "-022.22", "+100.00",
    },
    {"0 to +20 mA", I7000_UNIT_MA, 3, 0, 0, 0, 20000, 20000, 0x0000, 0xFFFF, 0, 20000, 1000, "+000.00", "+100.00"},
    {"+/-150 V", I7000_UNIT_V, 2, 1, 0, -15000, 15000, 15000, 0x8000, 0x7FFF, -15000, 15000, 100, "-100.00", "+100.00"},
    {"+/-50 V", I7000_UNIT_V, 3, 1, 0, -50000, 50000, 50000, 0x8000, 0x7FFF, -5000, 5000, 100, "-100.00", "+100.00"},
};
const i7000_sentinel i7000_sentinels[27] = {
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_ENGINEERING, 0, 0x03FFC000u, "+9999.9", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_ENGINEERING, 0, 0x03FFC000u, "-9999.9", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_PERCENT, 0, 0x03FFC000u, "+999.99", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_PERCENT, 0, 0x03FFC000u, "-999.99", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_HEX, 0, 0x03FFC000u, "7FFF", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_HEX, 0, 0x03FFC000u, "8000", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_ENGINEERING, 1, 0x03FFC000u, "+9999", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_ENGINEERING, 1, 0x03FFC000u, "-0000", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_PERCENT, 1, 0x03FFC000u, "+9999", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_PERCENT, 1, 0x03FFC000u, "-0000", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_HEX, 1, 0x03FFC000u, "+9999", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_HEX, 1, 0x03FFC000u, "-0000", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_ENGINEERING, 0, 0x00000080u, "-9999.9", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_PERCENT, 0, 0x00000080u, "-999.99", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_HEX, 0, 0x00000080u, "0000", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_ENGINEERING, 0, 0x1C003FFFu, "+9999.9", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_ENGINEERING, 0, 0x1C003F7Fu, "-9999.9", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_PERCENT, 0, 0x1C003FFFu, "+999.99", 0},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_PERCENT, 0, 0x1C003F7Fu, "-999.99", 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_MODBUS_HEX, 0, 0x03FFC000u, NULL, 32767},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_MODBUS_HEX, 0, 0x03FFC000u, NULL, 32768},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_MODBUS_HEX, 0, 0x00000080u, NULL, 0},
    {I7000_STATUS_OVER_RANGE, I7000_FORMAT_MODBUS_ENGINEERING, 0, 0x1FFFFFFFu, NULL, 32767},
    {I7000_STATUS_UNDER_RANGE, I7000_FORMAT_MODBUS_ENGINEERING, 0, 0x1FFFFFFFu, NULL, 32768},
    {I7000_STATUS_DISABLED, I7000_FORMAT_ENGINEERING, 0, 0x1FFFFFFFu, "       ", 0},
    {I7000_STATUS_DISABLED, I7000_FORMAT_PERCENT, 0, 0x1FFFFFFFu, "       ", 0},
    {I7000_STATUS_DISABLED, I7000_FORMAT_HEX, 0, 0x1FFFFFFFu, "    ", 0},
};
const i7000_model i7000_models[28] = {
    {
        "I-7017", 7017, 0, 8, 8, 0, 2, 2, 0x08, 1, 0, 0, 0, 0x04003F80u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017F", 7017, 0, 8, 8, 0, 2, 2, 0x08, 1, 0, 0, 1, 0x04003F80u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017C", 7017, 0, 8, 8, 0, 2, 2, 0x0D, 1, 0, 0, 0, 0x04002080u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017FC", 7017, 0, 8, 8, 0, 2, 2, 0x0D, 1, 0, 0, 1, 0x04002080u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017R", 7017, 0, 8, 8, 0, 2, 2, 0x08, 1, 0, 0, 1, 0x04003F80u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_FIRMWARE('B', 3, 9), I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017RC", 7017, 0, 8, 8, 0, 2, 2, 0x0D, 1, 0, 0, 1, 0x04002080u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017R-A5", 7017, 0, 8, 8, 0, 2, 2, 0x1B, 1, 0, 0, 1, 0x18000000u, 0x00000000u, I7000_ANY, I7000_NEVER,
        I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7017Z", 7017, 0, 10, 20, 1, 4, 6, 0x08, 0, 0, 0, 1, 0x04003F80u, 0x00000000u, I7000_ANY, I7000_ANY,
        I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017", 7017, 1, 8, 8, 0, 2, 2, 0x08, 1, 0, 0, 0, 0x04003F80u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017C", 7017, 1, 8, 8, 0, 2, 2, 0x0D, 1, 0, 0, 0, 0x04002080u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017R", 7017, 1, 8, 8, 0, 2, 2, 0x08, 1, 0, 0, 1, 0x04003F80u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_FIRMWARE('B', 3, 9), I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017RC", 7017, 1, 8, 8, 0, 2, 2, 0x0D, 1, 0, 0, 1, 0x04002080u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_NEVER, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017R-A5", 7017, 1, 8, 8, 0, 2, 2, 0x1B, 1, 0, 0, 1, 0x18000000u, 0x00000000u, I7000_ANY, I7000_NEVER,
        I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017Z", 7017, 1, 10, 20, 1, 4, 6, 0x08, 0, 0, 0, 1, 0x04003F80u, 0x00000000u, I7000_ANY, I7000_ANY,
        I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017RMS", 7017, 1, 8, 8, 0, 2, 2, 0x08, 1, 0, 0, 0, 0x00001F00u, 0x00000000u, I7000_ANY, I7000_ANY,
        I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "M-7017mC-16", 7017, 1, 16, 16, 0, 4, 4, 0x0D, 0, 0, 0, 1, 0x04002080u, 0x04000080u, I7000_FIRMWARE('B', 2, 2),
        I7000_ANY, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "I-7018", 7018, 0, 8, 8, 0, 2, 2, 0x05, 1, 1, 0, 0, 0x007FC07Fu, 0x00000000u, I7000_ANY, I7000_NEVER, I7000_ANY,
        I7000_FIRMWARE('B', 2, 9),
    },
    {
        "I-7018P", 7018, 0, 8, 8, 0, 2, 2, 0x05, 1, 1, 0, 0, 0x01FFC07Fu, 0x00000000u, I7000_ANY, I7000_NEVER,
        I7000_ANY, I7000_FIRMWARE('B', 2, 9),
    },
    {
        "I-7018BL", 7018, 0, 8, 8, 0, 2, 2, I7000_NO_TYPE, 1, 1, 1, 0, 0x007FC000u, 0x00000000u, I7000_ANY, I7000_NEVER,
        I7000_ANY, I7000_FIRMWARE('B', 2, 9),
    },
    {
        "I-7018R", 7018, 0, 8, 8, 0, 2, 2, 0x05, 1, 1, 1, 0, 0x03FFC07Fu, 0x00000000u, I7000_ANY,
        I7000_FIRMWARE('B', 4, 2), I7000_ANY, I7000_FIRMWARE('B', 2, 9),
    },
    {
        "I-7018Z", 7018, 0, 10, 10, 0, 4, 4, 0x05, 0, 1, 1, 0, 0x07FFC0FFu, 0x00000000u, I7000_ANY, I7000_ANY,
        I7000_ANY, I7000_FIRMWARE('B', 3, 1),
    },
    {
        "M-7018", 7018, 1, 8, 8, 0, 2, 2, 0x05, 1, 1, 0, 0, 0x007FC07Fu, 0x00000000u, I7000_ANY, I7000_NEVER, I7000_ANY,
        I7000_FIRMWARE('B', 2, 9),
    },
    {
        "M-7018R", 7018, 1, 8, 8, 0, 2, 2, 0x05, 1, 1, 1, 0, 0x03FFC07Fu, 0x00000000u, I7000_ANY,
        I7000_FIRMWARE('B', 4, 5), I7000_ANY, I7000_FIRMWARE('B', 2, 9),
    },
    {
        "M-7018Z", 7018, 1, 10, 10, 0, 4, 4, 0x05, 0, 1, 1, 0, 0x07FFC0FFu, 0x00000000u, I7000_ANY, I7000_ANY,
        I7000_ANY, I7000_FIRMWARE('B', 3, 1),
    },
    {
        "M-7018-16", 7018, 1, 16, 16, 0, 4, 4, 0x05, 1, 1, 1, 0, 0x007FC07Fu, 0x00000000u, I7000_ANY, I7000_NEVER,
        I7000_ANY, I7000_FIRMWARE('B', 2, 9),
    },
    {
        "I-7019R", 7019, 0, 8, 8, 0, 2, 2, 0x08, 0, 1, 1, 0, 0x07FFFFFFu, 0x04000080u, I7000_FIRMWARE('B', 2, 7),
        I7000_ANY, I7000_FIRMWARE('B', 2, 7), I7000_FIRMWARE('B', 3, 1),
    },
    {
        "M-7019R", 7019, 1, 8, 8, 0, 2, 2, 0x08, 0, 1, 1, 0, 0x07FFFFFFu, 0x04000080u, I7000_FIRMWARE('B', 2, 7),
        I7000_ANY, I7000_FIRMWARE('B', 2, 7), I7000_FIRMWARE('B', 3, 1),
    },
    {
        "M-7019Z", 7019, 1, 10, 10, 0, 4, 4, 0x08, 0, 1, 1, 0, 0x07FFFFFFu, 0x00000000u, I7000_ANY, I7000_ANY,
        I7000_ANY, I7000_FIRMWARE('B', 3, 1),
    },
};
const i7000_dcon_command i7000_dcon_commands[43] = {
    {
        "SetConfiguration", "2.1", "%AANNTTCCFF", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"%", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"NN", I7000_FIELD_NEW_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"TT", I7000_FIELD_TYPE_CODE, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"CC", I7000_FIELD_LINE_SETTINGS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 3, 202},
            {"FF", I7000_FIELD_REPORT_SETTINGS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 226},
        },
        6,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SynchronizedSampling", "2.2", "#**", NULL, I7000_NO_MESSAGE,
        (const i7000_part[]){
            {"#**", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 3, 3, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        1, NULL, 0,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 2, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadAnalogInputs", "2.3", "#AA", ">(Data)", I7000_DCON_ANALOG_INPUTS,
        (const i7000_part[]){
            {"#", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_part[]){
            {">", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {
                "(Data)", I7000_FIELD_VALUES, I7000_KIND_READINGS, I7000_WIDTH_READING_DIGITS, 4, 7, I7000_NO_MINIMUM,
                I7000_NO_MAXIMUM,
            },
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadAnalogInput", "2.4", "#AAN", ">(Data)", I7000_DCON_ANALOG_INPUT,
        (const i7000_part[]){
            {"#", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"N", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_CHANNEL_DIGITS, 1, 2, 0, 19},
        },
        3,
        (const i7000_part[]){
            {">", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {
                "(Data)", I7000_FIELD_VALUE, I7000_KIND_READING, I7000_WIDTH_READING_DIGITS, 4, 7, I7000_NO_MINIMUM,
                I7000_NO_MAXIMUM,
            },
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "CalibrateSpan", "2.5", "$AA0", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"0", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x01FFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "CalibrateZero", "2.6", "$AA1", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"1", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x01FFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "CalibrateCurrentChannelSpan", "2.7", "$AA0Ci", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"0C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_FIXED, 1, 1, 0, 15},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x00008000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "CalibrateChannelZero", "2.8", "$AA0Ci", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"0C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_FIXED, 1, 1, 0, 9},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 16000, 1, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "CalibrateChannelSpan", "2.9", "$AA1Ci", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"1C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_FIXED, 1, 1, 0, 9},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 16000, 1, I7000_ANY, I7000_FIRMWARE('B', 2, 6),
    },
    {
        "ReadConfiguration", "2.10", "$AA2", "!AATTCCFF", I7000_DCON_CONFIGURATION,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"2", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"TT", I7000_FIELD_TYPE_CODE, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"CC", I7000_FIELD_LINE_SETTINGS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 3, 202},
            {"FF", I7000_FIELD_REPORT_SETTINGS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 226},
        },
        5,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadCjcTemperature", "2.11", "$AA3", ">(Data)", I7000_DCON_CJC_TEMPERATURE,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"3", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {">", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"(Data)", I7000_FIELD_TEMPERATURE, I7000_KIND_DECIMAL, I7000_WIDTH_FIXED, 7, 7, -9999, 9999},
        },
        2,
        (const i7000_gate[]){{0x0FFF0000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadSynchronizedData", "2.12", "$AA4", ">AAS(Data)", I7000_DCON_SYNCHRONIZED_DATA,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"4", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {">", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"S", I7000_FIELD_FIRST_READING, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
            {
                "(Data)", I7000_FIELD_VALUES, I7000_KIND_READINGS, I7000_WIDTH_READING_DIGITS, 4, 7, I7000_NO_MINIMUM,
                I7000_NO_MAXIMUM,
            },
        },
        4,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetChannelMask", "2.13", "$AA5VV", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"5", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"VV", I7000_FIELD_MASK, I7000_KIND_HEX, I7000_WIDTH_MASK_DIGITS, 2, 6, 0, 1048575},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadChannelMask", "2.14", "$AA6", "!AAVV", I7000_DCON_CHANNEL_MASK,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"6", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"VV", I7000_FIELD_MASK, I7000_KIND_HEX, I7000_WIDTH_MASK_DIGITS, 2, 6, 0, 1048575},
        },
        3,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetChannelTypeCode", "2.15", "$AA7CiRrr", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"7C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_CHANNEL_DIGITS, 1, 2, 0, 19},
            {"R", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"rr", I7000_FIELD_TYPE_CODE, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 26},
        },
        6,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){
            {0x00000410u, I7000_FIRMWARE('B', 3, 9)},
            {0x0E90E080u, I7000_ANY},
            {0x00080000u, I7000_FIRMWARE('B', 4, 2)},
            {0x00400000u, I7000_FIRMWARE('B', 4, 5)},
        },
        4, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadChannelTypeCode", "2.16", "$AA8Ci", "!AACiRrr", I7000_DCON_CHANNEL_TYPE_CODE,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"8C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_CHANNEL_DIGITS, 1, 2, 0, 19},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_CHANNEL, I7000_KIND_HEX, I7000_WIDTH_CHANNEL_DIGITS, 1, 2, 0, 19},
            {"R", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"rr", I7000_FIELD_TYPE_CODE, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 26},
        },
        6,
        (const i7000_gate[]){
            {0x00000410u, I7000_FIRMWARE('B', 3, 9)},
            {0x0E90E080u, I7000_ANY},
            {0x00080000u, I7000_FIRMWARE('B', 4, 2)},
            {0x00400000u, I7000_FIRMWARE('B', 4, 5)},
        },
        4, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadCjcOffset", "2.17", "$AA9", "!AA(Data)", I7000_DCON_CJC_OFFSET,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"9", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"(Data)", I7000_FIELD_OFFSET, I7000_KIND_SIGNED_HEX, I7000_WIDTH_FIXED, 5, 5, -4096, 4096},
        },
        3,
        (const i7000_gate[]){{0x0FFF0000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetCjcOffset", "2.18", "$AA9SNNNN", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"9", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"SNNNN", I7000_FIELD_OFFSET, I7000_KIND_SIGNED_HEX, I7000_WIDTH_FIXED, 5, 5, -4096, 4096},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFF0000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadAnalogInputsHex", "2.19", "$AAA", ">(Data)", I7000_DCON_ANALOG_INPUTS_HEX,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"A", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {">", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {
                "(Data)", I7000_FIELD_VALUES, I7000_KIND_READINGS, I7000_WIDTH_FIXED, 4, 4, I7000_NO_MINIMUM,
                I7000_NO_MAXIMUM,
            },
        },
        2,
        (const i7000_gate[]){{0x0000FFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadCjcUpdate", "2.20", "$AAA", "!AAi", I7000_DCON_CJC_UPDATE_SETTING,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"A", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"i", I7000_FIELD_UPDATE, I7000_KIND_CODE, I7000_WIDTH_FIXED, 1, 1, 0, 2},
        },
        3,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetCjcUpdate", "2.21", "$AAAi", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"A", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"i", I7000_FIELD_UPDATE, I7000_KIND_CODE, I7000_WIDTH_FIXED, 1, 1, 0, 2},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadDiagnostics", "2.22", "$AAB", "!AANN", I7000_DCON_DIAGNOSTICS,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"B", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"NN", I7000_FIELD_MASK, I7000_KIND_HEX, I7000_WIDTH_MASK_DIGITS, 2, 4, 0, 1023},
        },
        3,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadFirmwareVersion", "2.23", "$AAF", "!AA(Data)", I7000_DCON_FIRMWARE_VERSION,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"F", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {
                "(Data)", I7000_FIELD_VERSION, I7000_KIND_VERSION, I7000_WIDTH_LENGTH, 4, 5, I7000_NO_MINIMUM,
                I7000_NO_MAXIMUM,
            },
        },
        3,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadModuleName", "2.24", "$AAM", "!AA(Name)", I7000_DCON_MODULE_NAME,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"M", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"(Name)", I7000_FIELD_NAME, I7000_KIND_NAME, I7000_WIDTH_LENGTH, 1, 6, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadProtocol", "2.25", "$AAP", "!AASC", I7000_DCON_PROTOCOL_SETTING,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"P", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"S", I7000_FIELD_MODBUS_SUPPORTED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
            {"C", I7000_FIELD_PROTOCOL, I7000_KIND_CODE, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        4,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetProtocol", "2.26", "$AAPN", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"P", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"N", I7000_FIELD_PROTOCOL, I7000_KIND_CODE, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "CalibrateInternally", "2.27", "$AAS0", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"S0", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E000000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReloadDefaultCalibration", "2.28", "$AAS1", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"$", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"S1", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E008000u, I7000_ANY}},
        1, 3000, 1, I7000_FIRMWARE('B', 2, 7), I7000_NEVER,
    },
    {
        "ReadCjcEnabled", "2.29", "~AAC", "!AAN", I7000_DCON_CJC_ENABLED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"N", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        3,
        (const i7000_gate[]){{0x0FFF0000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetCjcEnabled", "2.30", "~AACN", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"C", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"N", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFF0000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetCalibrationEnabled", "2.31", "~AAEV", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"E", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"V", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SoftInit", "2.32", "~AAI", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"I", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E008000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetModuleName", "2.33", "~AAO(Name)", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"O", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"(Name)", I7000_FIELD_NAME, I7000_KIND_NAME, I7000_WIDTH_LENGTH, 1, 6, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetSoftInitTimeout", "2.34", "~AATnn", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"T", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"nn", I7000_FIELD_TIMEOUT, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 60},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0E008000u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "HostOk", "2.35", "~**", NULL, I7000_NO_MESSAGE,
        (const i7000_part[]){
            {"~**", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 3, 3, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        1, NULL, 0,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 2, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadHostWatchdogStatus", "2.36", "~AA0", "!AASS", I7000_DCON_HOST_WATCHDOG_STATUS,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"0", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"SS", I7000_FIELD_STATUS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ResetHostWatchdogStatus", "2.37", "~AA1", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"1", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadHostWatchdogTimeout", "2.38", "~AA2", "!AAEVV", I7000_DCON_HOST_WATCHDOG_TIMEOUT,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"2", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"E", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
            {"VV", I7000_FIELD_TIMEOUT, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        4,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetHostWatchdogTimeout", "2.39", "~AA3EVV", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"3", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"E", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
            {"VV", I7000_FIELD_TIMEOUT, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        5,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x0FFFFFFFu, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadOpenWireDetection", "2.40", "~AAEO", "!AAN", I7000_DCON_OPEN_WIRE_DETECTION,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"EO", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"N", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        3,
        (const i7000_gate[]){{0x00480000u, I7000_FIRMWARE('B', 4, 2)}, {0x0E000000u, I7000_FIRMWARE('B', 3, 7)}},
        2, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetOpenWireDetection", "2.41", "~AAEON", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"~", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"EO", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 2, 2, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"N", I7000_FIELD_ENABLED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x00480000u, I7000_FIRMWARE('B', 4, 2)}, {0x0E000000u, I7000_FIRMWARE('B', 3, 7)}},
        2, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "ReadConnectingMode", "2.42", "@AAS", "!AAN", I7000_DCON_CONNECTING_MODE,
        (const i7000_part[]){
            {"@", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"S", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"N", I7000_FIELD_SINGLE_ENDED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        3,
        (const i7000_gate[]){{0x00002080u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
    {
        "SetConnectingMode", "2.43", "@AASN", "!AA", I7000_DCON_ACKNOWLEDGED,
        (const i7000_part[]){
            {"@", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
            {"S", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"N", I7000_FIELD_SINGLE_ENDED, I7000_KIND_BOOL, I7000_WIDTH_FIXED, 1, 1, 0, 1},
        },
        4,
        (const i7000_part[]){
            {"!", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
        },
        2,
        (const i7000_gate[]){{0x00002080u, I7000_ANY}},
        1, 0, 0, I7000_ANY, I7000_NEVER,
    },
};
const i7000_modbus_request i7000_modbus_functions[8] = {
    {
        "ReadCoils", "3.4", 0x01, I7000_NO_SUB_FUNCTION, 0, 1, 2000, I7000_MODBUS_COILS, "01 start:2 count:2",
        "01 bytes values:bits",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 1, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, 1, 2000},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 1, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BYTES, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BITS, 0, 0, I7000_FIELD_VALUES, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){
            {0x04001F00u, I7000_FIRMWARE('B', 3, 0)},
            {0x0980E000u, I7000_ANY},
            {0x00600000u, I7000_FIRMWARE('B', 3, 5)},
        },
        3,
    },
    {
        "ReadDiscreteInputs", "3.1", 0x02, I7000_NO_SUB_FUNCTION, 0, 1, 2000, I7000_MODBUS_DISCRETE_INPUTS,
        "02 start:2 count:2", "02 bytes values:bits",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 2, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, 1, 2000},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 2, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BYTES, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BITS, 0, 0, I7000_FIELD_VALUES, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){{0x00001F00u, I7000_FIRMWARE('B', 3, 0)}, {0x0C00A000u, I7000_ANY}},
        2,
    },
    {
        "ReadHoldingRegisters", "3.4", 0x03, I7000_NO_SUB_FUNCTION, 0, 1, 125, I7000_MODBUS_HOLDING_REGISTERS,
        "03 start:2 count:2", "03 bytes values:words",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 3, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, 1, 125},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 3, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BYTES, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_WORDS, 0, 0, I7000_FIELD_VALUES, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){
            {0x04001F00u, I7000_FIRMWARE('B', 3, 0)},
            {0x0980E000u, I7000_ANY},
            {0x00600000u, I7000_FIRMWARE('B', 3, 5)},
        },
        3,
    },
    {
        "ReadInputRegisters", "3.2", 0x04, I7000_NO_SUB_FUNCTION, 0, 1, 125, I7000_MODBUS_INPUT_REGISTERS,
        "04 start:2 count:2", "04 bytes values:words",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 4, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, 1, 125},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 4, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BYTES, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_WORDS, 0, 0, I7000_FIELD_VALUES, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "WriteSingleCoil", "3.4", 0x05, I7000_NO_SUB_FUNCTION, 1, 0, 0, I7000_MODBUS_SINGLE_COIL_WRITTEN,
        "05 coil:2 value:2", "05 coil:2 value:2",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 5, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COIL, 0, 65535},
            {I7000_TOKEN_COIL, 2, 0, I7000_FIELD_VALUE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 5, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COIL, 0, 65535},
            {I7000_TOKEN_COIL, 2, 0, I7000_FIELD_VALUE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){
            {0x04001F00u, I7000_FIRMWARE('B', 3, 0)},
            {0x0980E000u, I7000_ANY},
            {0x00600000u, I7000_FIRMWARE('B', 3, 5)},
        },
        3,
    },
    {
        "WriteSingleRegister", "3.4", 0x06, I7000_NO_SUB_FUNCTION, 1, 0, 0, I7000_MODBUS_SINGLE_REGISTER_WRITTEN,
        "06 register:2 value:2", "06 register:2 value:2",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 6, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_REGISTER, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_VALUE, 0, 65535},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 6, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_REGISTER, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_VALUE, 0, 65535},
        },
        3,
        (const i7000_gate[]){
            {0x04001F00u, I7000_FIRMWARE('B', 3, 0)},
            {0x0980E000u, I7000_ANY},
            {0x00600000u, I7000_FIRMWARE('B', 3, 5)},
        },
        3,
    },
    {
        "WriteMultipleCoils", "3.4", 0x0F, I7000_NO_SUB_FUNCTION, 1, 1, 1968, I7000_MODBUS_MULTIPLE_COILS_WRITTEN,
        "0F start:2 count:2 bytes values:bits", "0F start:2 count:2",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 15, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BYTES, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BITS, 0, 0, I7000_FIELD_VALUES, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        5,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 15, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, 1, 1968},
        },
        3,
        (const i7000_gate[]){
            {0x04001F00u, I7000_FIRMWARE('B', 3, 0)},
            {0x0980E000u, I7000_ANY},
            {0x00600000u, I7000_FIRMWARE('B', 3, 5)},
        },
        3,
    },
    {
        "WriteMultipleRegisters", "3.4", 0x10, I7000_NO_SUB_FUNCTION, 1, 1, 123,
        I7000_MODBUS_MULTIPLE_REGISTERS_WRITTEN, "10 start:2 count:2 bytes values:words", "10 start:2 count:2",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 16, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BYTES, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_WORDS, 0, 0, I7000_FIELD_VALUES, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        5,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 16, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_START, 0, 65535},
            {I7000_TOKEN_UNSIGNED, 2, 0, I7000_FIELD_COUNT, 1, 123},
        },
        3,
        (const i7000_gate[]){
            {0x04001F00u, I7000_FIRMWARE('B', 3, 0)},
            {0x0980E000u, I7000_ANY},
            {0x00600000u, I7000_FIRMWARE('B', 3, 5)},
        },
        3,
    },
};
const i7000_modbus_request i7000_module_settings[17] = {
    {
        "ReadModuleName", "3.3.1", 0x46, 0x00, 0, 0, 0, I7000_MODBUS_MODULE_NAME, "46 00", "46 00 name:4",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        2,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_DIGITS, 4, 0, I7000_FIELD_NAME, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "SetModuleAddress", "3.3.2", 0x46, 0x04, 0, 0, 0, I7000_MODBUS_MODULE_ADDRESS_RESULT,
        "46 04 new_address 00 00 00", "46 04 result 00 00 00",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 4, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_NEW_ADDRESS, 1, 247},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        6,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 4, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        6,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "ReadCommunicationSettings", "3.3.3", 0x46, 0x05, 0, 0, 0, I7000_MODBUS_COMMUNICATION_SETTINGS, "46 05 00",
        "46 05 00 line_settings 00 00 00 protocol 00 00",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 5, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 5, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_LINE_SETTINGS, 3, 202},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_CODE, 1, 0, I7000_FIELD_PROTOCOL, 0, 1},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        10,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "SetCommunicationSettings", "3.3.4", 0x46, 0x06, 0, 0, 0, I7000_MODBUS_COMMUNICATION_SETTINGS_RESULT,
        "46 06 00 line_settings 00 00 00 protocol 00 00", "46 06 00 line_result 00 00 00 protocol_result 00 00",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 6, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_LINE_SETTINGS, 3, 202},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_CODE, 1, 0, I7000_FIELD_PROTOCOL, 0, 1},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        10,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 6, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_LINE_RESULT, 0, 255},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_PROTOCOL_RESULT, 0, 255},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        10,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "ReadTypeCode", "3.3.5", 0x46, 0x07, 0, 0, 0, I7000_MODBUS_TYPE_CODE_SETTING, "46 07 00 channel",
        "46 07 type_code",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 7, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_CHANNEL, 0, 19},
        },
        4,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 7, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_TYPE_CODE, 0, 28},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "SetTypeCode", "3.3.6", 0x46, 0x08, 0, 0, 0, I7000_MODBUS_TYPE_CODE_RESULT, "46 08 00 channel type_code",
        "46 08 result",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 8, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_CHANNEL, 0, 19},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_TYPE_CODE, 0, 28},
        },
        5,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 8, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "ReadFirmwareVersion", "3.3.7", 0x46, 0x20, 0, 0, 0, I7000_MODBUS_FIRMWARE_VERSION, "46 20",
        "46 20 major minor build",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 32, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        2,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 32, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_MAJOR, 0, 255},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_MINOR, 0, 255},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_BUILD, 0, 255},
        },
        5,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "ReadChannelMask", "3.3.8", 0x46, 0x25, 0, 0, 0, I7000_MODBUS_CHANNEL_MASK, "46 25", "46 25 mask:mask",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 37, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        2,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 37, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_MASK, 0, 0, I7000_FIELD_MASK, 0, 1048575},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "SetChannelMask", "3.3.9", 0x46, 0x26, 0, 0, 0, I7000_MODBUS_CHANNEL_MASK_RESULT, "46 26 mask:mask",
        "46 26 result",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 38, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_MASK, 0, 0, I7000_FIELD_MASK, 0, 1048575},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 38, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "ReadMiscellaneousSettings", "3.3.10", 0x46, 0x29, 0, 0, 0, I7000_MODBUS_MISCELLANEOUS_SETTINGS, "46 29",
        "46 29 settings",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 41, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        2,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 41, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_SETTINGS, 0, 160},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "SetMiscellaneousSettings", "3.3.11", 0x46, 0x2A, 0, 0, 0, I7000_MODBUS_MISCELLANEOUS_SETTINGS_RESULT,
        "46 2A settings", "46 2A result",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 42, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_SETTINGS, 0, 160},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 42, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0DE0FF00u, I7000_ANY}},
        1,
    },
    {
        "ReadCjcOffset", "3.3.12", 0x46, 0x2B, 0, 0, 0, I7000_MODBUS_CJC_OFFSET, "46 2B channel", "46 2B offset:2",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 43, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_CHANNEL, 0, 143},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 43, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_SIGNED, 2, 0, I7000_FIELD_OFFSET, -4096, 4096},
        },
        3,
        (const i7000_gate[]){{0x0DE00000u, I7000_ANY}},
        1,
    },
    {
        "SetCjcOffset", "3.3.13", 0x46, 0x2C, 0, 0, 0, I7000_MODBUS_CJC_OFFSET_RESULT, "46 2C channel offset:2",
        "46 2C result",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 44, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_CHANNEL, 0, 143},
            {I7000_TOKEN_SIGNED, 2, 0, I7000_FIELD_OFFSET, -4096, 4096},
        },
        4,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 44, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0DE00000u, I7000_ANY}},
        1,
    },
    {
        "ReadCjcEnabled", "3.3.14", 0x46, 0x2D, 0, 0, 0, I7000_MODBUS_CJC_ENABLED, "46 2D 00", "46 2D enabled",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 45, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 45, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BOOL, 1, 0, I7000_FIELD_ENABLED, 0, 1},
        },
        3,
        (const i7000_gate[]){{0x0DE00000u, I7000_ANY}},
        1,
    },
    {
        "SetCjcEnabled", "3.3.15", 0x46, 0x2E, 0, 0, 0, I7000_MODBUS_CJC_ENABLED_RESULT, "46 2E 00 enabled",
        "46 2E result",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 46, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 0, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_BOOL, 1, 0, I7000_FIELD_ENABLED, 0, 1},
        },
        4,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 46, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0DE00000u, I7000_ANY}},
        1,
    },
    {
        "ReadCjcUpdate", "3.3.16", 0x46, 0x2F, 0, 0, 0, I7000_MODBUS_CJC_UPDATE_SETTING, "46 2F", "46 2F update",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 47, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
        },
        2,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 47, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_CODE, 1, 0, I7000_FIELD_UPDATE, 0, 2},
        },
        3,
        (const i7000_gate[]){{0x0C000000u, I7000_ANY}},
        1,
    },
    {
        "SetCjcUpdate", "3.3.17", 0x46, 0x30, 0, 0, 0, I7000_MODBUS_CJC_UPDATE_RESULT, "46 30 update", "46 30 result",
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 48, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_CODE, 1, 0, I7000_FIELD_UPDATE, 0, 2},
        },
        3,
        (const i7000_token[]){
            {I7000_TOKEN_LITERAL, 1, 70, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_LITERAL, 1, 48, I7000_FIELD_NONE, I7000_NO_MINIMUM, I7000_NO_MAXIMUM},
            {I7000_TOKEN_UNSIGNED, 1, 0, I7000_FIELD_RESULT, 0, 255},
        },
        3,
        (const i7000_gate[]){{0x0C000000u, I7000_ANY}},
        1,
    },
};
const i7000_map i7000_maps[9] = {
    {
        "3.4.1", 0x00001F00u, I7000_FIRMWARE('B', 3, 0), 0,
        (const i7000_register[]){
            {
                "range_status", NULL, 0, 10129, 128, 8, I7000_AREA_DISCRETE_INPUT, I7000_READ, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "range_status", NULL, 0, 129, 128, 8, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 30001, 0, 8, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00000400u, I7000_FIRMWARE('B', 3, 9),
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "module_type_code", NULL, 0, 40487, 486, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 255, NULL, 0, 0x00001F00u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x00001F00u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x00001F00u, I7000_ANY,
            },
            {
                "fast_mode", NULL, 0, 271, 270, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "normal mode"}, {1, "fast mode"}},
                2, 0x00001C00u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x00001F00u, I7000_ANY,
            },
        },
        21,
    },
    {
        "3.4.2", 0x00004000u, I7000_ANY, 0,
        (const i7000_register[]){
            {
                "analog_input", NULL, 0, 30001, 0, 8, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "module_type_code", NULL, 0, 40487, 486, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 255, NULL, 0, 0x00004000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x00004000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x00004000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x00004000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00004000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x00004000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x00004000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x00004000u, I7000_ANY,
            },
        },
        18,
    },
    {
        "3.4.3", 0x00008000u, I7000_ANY, 0,
        (const i7000_register[]){
            {
                "analog_input", NULL, 0, 30001, 0, 16, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 16, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "rtc_epoch", "s", 1, 40017, 16, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 16, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 65535, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x00008000u, I7000_ANY,
            },
            {
                "rtc_year", NULL, 0, 40865, 864, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 2000, 2159, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "rtc_month", NULL, 0, 40866, 865, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 12, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "rtc_date", NULL, 0, 40867, 866, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 31, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "rtc_hour", NULL, 0, 40868, 867, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 23, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "rtc_minute", NULL, 0, 40869, 868, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "rtc_second", NULL, 0, 40870, 869, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_last_index", NULL, 0, 40871, 870, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_read_index", NULL, 0, 40873, 872, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_status", NULL, 0, 40875, 874, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_CODE, 0,
                1,
                (const i7000_value[]){{0, "stopped"}, {1, "running"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "log_command", NULL, 0, 40876, 875, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 2,
                (const i7000_value[]){{0, "stop"}, {1, "run in continuous mode"}, {2, "run in period mode"}},
                3, 0x00008000u, I7000_ANY,
            },
            {
                "log_overwrite", NULL, 0, 40877, 876, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 1,
                (const i7000_value[]){{0, "stop"}, {1, "go on writing"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "log_period_hour", "h", 1, 40878, 877, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 24, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_period_minute", "min", 1, 40879, 878, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_period_second", "s", 1, 40880, 879, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_start_year", NULL, 0, 40881, 880, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 2000, 2159, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_start_month", NULL, 0, 40882, 881, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 12, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_start_date", NULL, 0, 40883, 882, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 31, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_start_hour", NULL, 0, 40884, 883, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 23, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_start_minute", NULL, 0, 40885, 884, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_start_second", NULL, 0, 40886, 885, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_end_year", NULL, 0, 40887, 886, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 2000, 2159, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_end_month", NULL, 0, 40888, 887, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 12, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_end_date", NULL, 0, 40889, 888, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 31, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_end_hour", NULL, 0, 40890, 889, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 23, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_end_minute", NULL, 0, 40891, 890, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_end_second", NULL, 0, 40892, 891, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 59, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_records", NULL, 0, 31001, 1000, 108, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_RECORD,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "log_records", NULL, 0, 41001, 1000, 108, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_RECORD, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00008000u, I7000_ANY,
            },
            {
                "range_status", NULL, 0, 10129, 128, 16, I7000_AREA_DISCRETE_INPUT, I7000_READ, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "range_status", NULL, 0, 129, 128, 16, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "fast_mode", NULL, 0, 271, 270, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "normal mode"}, {1, "fast mode"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "load_factory_calibration", NULL, 0, 272, 271, 1, I7000_AREA_COIL, I7000_WRITE, I7000_REGISTER_BOOL, 1,
                1,
                (const i7000_value[]){{1, "load the calibration of the factory"}},
                1, 0x00008000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x00008000u, I7000_ANY,
            },
            {
                "big_endian", NULL, 0, 283, 282, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "little-endian"}, {1, "big-endian"}},
                2, 0x00008000u, I7000_ANY,
            },
        },
        50,
    },
    {
        "3.4.4", 0x00002000u, I7000_ANY, 0,
        (const i7000_register[]){
            {
                "range_status", NULL, 0, 10129, 128, 10, I7000_AREA_DISCRETE_INPUT, I7000_READ, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "range_status", NULL, 0, 129, 128, 10, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 30001, 0, 20, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 20, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 20, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 65535, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x00002000u, I7000_ANY,
            },
            {
                "channel_mask_high", NULL, 0, 40497, 496, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 15, NULL, 0, 0x00002000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "host_watchdog_mode", NULL, 0, 260, 259, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){
                    {0, "as on the I-7000 series"},
                    {1, "analog and digital output commands clear the time-out status"},
                },
                2, 0x00002000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "fast_mode", NULL, 0, 271, 270, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "normal mode"}, {1, "fast mode"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x00002000u, I7000_ANY,
            },
            {
                "single_ended", NULL, 0, 277, 276, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "differential"}, {1, "single-ended"}},
                2, 0x00002000u, I7000_ANY,
            },
        },
        23,
    },
    {
        "3.4.5", 0x00600000u, I7000_FIRMWARE('B', 3, 5), 0,
        (const i7000_register[]){
            {
                "analog_input", NULL, 0, 30001, 0, 8, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 30129, 128, 1, I7000_AREA_INPUT_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 40129, 128, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00400000u, I7000_FIRMWARE('B', 4, 5),
            },
            {
                "cjc_offset", "degC", 10, 40353, 352, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT8, -128, 127, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "module_type_code", NULL, 0, 40487, 486, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 255, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "module_cjc_offset", "degC", 100, 40491, 490, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x00600000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x00600000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "host_watchdog_mode", NULL, 0, 260, 259, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){
                    {0, "as on the I-7000 series"},
                    {1, "analog and digital output commands clear the time-out status"},
                },
                2, 0x00600000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "cjc_enabled", NULL, 0, 268, 267, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x00600000u, I7000_ANY,
            },
            {
                "open_wire_detection", NULL, 0, 276, 275, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00400000u, I7000_FIRMWARE('B', 4, 5),
            },
        },
        25,
    },
    {
        "3.4.6", 0x00800000u, I7000_ANY, 0,
        (const i7000_register[]){
            {
                "analog_input", NULL, 0, 30001, 0, 10, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 30129, 128, 1, I7000_AREA_INPUT_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 40129, 128, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "cjc_offset", "degC", 10, 40353, 352, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT8, -128, 127, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 1023, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "module_cjc_offset", "degC", 100, 40491, 490, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x00800000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x00800000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "host_watchdog_mode", NULL, 0, 260, 259, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){
                    {0, "as on the I-7000 series"},
                    {1, "analog and digital output commands clear the time-out status"},
                },
                2, 0x00800000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "cjc_enabled", NULL, 0, 268, 267, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x00800000u, I7000_ANY,
            },
            {
                "open_wire_detection", NULL, 0, 276, 275, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x00800000u, I7000_FIRMWARE('B', 4, 4),
            },
        },
        24,
    },
    {
        "3.4.7", 0x01000000u, I7000_ANY, 0,
        (const i7000_register[]){
            {
                "analog_input", NULL, 0, 30001, 0, 16, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 16, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "temperature", "degC", 1, 30033, 32, 16, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_INT16,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "temperature", "degC", 1, 40033, 32, 16, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_INT16,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 30129, 128, 1, I7000_AREA_INPUT_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 40129, 128, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "cjc_offset", "degC", 10, 40353, 352, 16, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT8, -128, 127, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "module_type_code", NULL, 0, 40487, 486, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 65535, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "module_cjc_offset", "degC", 100, 40491, 490, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x01000000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x01000000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x01000000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x01000000u, I7000_ANY,
            },
            {
                "host_watchdog_mode", NULL, 0, 260, 259, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){
                    {0, "as on the I-7000 series"},
                    {1, "analog and digital output commands clear the time-out status"},
                },
                2, 0x01000000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x01000000u, I7000_ANY,
            },
            {
                "cjc_enabled", NULL, 0, 268, 267, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x01000000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x01000000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x01000000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x01000000u, I7000_ANY,
            },
        },
        25,
    },
    {
        "3.4.8", 0x04000000u, I7000_FIRMWARE('B', 3, 0), 11,
        (const i7000_register[]){
            {
                "range_status", NULL, 0, 10129, 128, 8, I7000_AREA_DISCRETE_INPUT, I7000_READ, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "range_status", NULL, 0, 129, 128, 8, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 30001, 0, 8, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 30129, 128, 1, I7000_AREA_INPUT_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 40129, 128, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "temperature_offset", "degC", 10, 40289, 288, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -128, 127, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "cjc_offset", "degC", 100, 40353, 352, 8, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 255, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "module_cjc_offset", "degC", 100, 40491, 490, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x04000000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x04000000u, I7000_ANY,
            },
            {
                "cjc_update", NULL, 0, 40493, 492, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 2,
                (const i7000_value[]){{0, "stopped"}, {1, "running"}, {2, "once"}},
                3, 0x04000000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "host_watchdog_mode", NULL, 0, 260, 259, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){
                    {0, "as on the I-7000 series"},
                    {1, "analog and digital output commands clear the time-out status"},
                },
                2, 0x04000000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "cjc_enabled", NULL, 0, 268, 267, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "load_factory_calibration", NULL, 0, 272, 271, 1, I7000_AREA_COIL, I7000_WRITE, I7000_REGISTER_BOOL, 1,
                1,
                (const i7000_value[]){{1, "load the calibration of the factory"}},
                1, 0x04000000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "sampling_rate", NULL, 0, 274, 273, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL,
                0, 1,
                (const i7000_value[]){{0, "10 Hz"}, {1, "8 Hz"}},
                2, 0x04000000u, I7000_ANY,
            },
            {
                "open_wire_detection", NULL, 0, 276, 275, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x04000000u, I7000_FIRMWARE('B', 3, 7),
            },
        },
        30,
    },
    {
        "3.4.9", 0x08000000u, I7000_ANY, 11,
        (const i7000_register[]){
            {
                "range_status", NULL, 0, 10129, 128, 10, I7000_AREA_DISCRETE_INPUT, I7000_READ, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "range_status", NULL, 0, 129, 128, 10, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "in range, or disabled"}, {1, "over or under range"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 30001, 0, 10, I7000_AREA_INPUT_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "analog_input", NULL, 0, 40001, 0, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_READING,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 30129, 128, 1, I7000_AREA_INPUT_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "cjc_temperature", "degC", 100, 40129, 128, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_INT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "type_code", NULL, 0, 40257, 256, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 28, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "temperature_offset", "degC", 10, 40289, 288, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -128, 127, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "cjc_offset", "degC", 100, 40353, 352, 10, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "firmware_version", NULL, 0, 40481, 480, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ,
                I7000_REGISTER_UINT32, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "module_name", NULL, 0, 40483, 482, 2, I7000_AREA_HOLDING_REGISTER, I7000_READ, I7000_REGISTER_UINT32,
                I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "module_address", NULL, 0, 40485, 484, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 1, 247, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "line_settings", NULL, 0, 40486, 485, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 3, 202, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "response_delay", "ms", 1, 40488, 487, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 30, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout", "s", 10, 40489, 488, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_UINT16, 0, 255, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "channel_mask", NULL, 0, 40490, 489, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BITS, 0, 1023, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "module_cjc_offset", "degC", 100, 40491, 490, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_INT16, -4096, 4096, NULL, 0, 0x08000000u, I7000_ANY,
            },
            {
                "host_watchdog_timeout_count", NULL, 0, 40492, 491, 1, I7000_AREA_HOLDING_REGISTER,
                I7000_READ | I7000_WRITE, I7000_REGISTER_UINT16, I7000_NO_MINIMUM, I7000_NO_MAXIMUM, NULL, 0,
                0x08000000u, I7000_ANY,
            },
            {
                "cjc_update", NULL, 0, 40493, 492, 1, I7000_AREA_HOLDING_REGISTER, I7000_READ | I7000_WRITE,
                I7000_REGISTER_CODE, 0, 2,
                (const i7000_value[]){{0, "stopped"}, {1, "running"}, {2, "once"}},
                3, 0x08000000u, I7000_ANY,
            },
            {
                "protocol", NULL, 0, 257, 256, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "DCON"}, {1, "Modbus RTU"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "filter", NULL, 0, 259, 258, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "60 Hz rejection"}, {1, "50 Hz rejection"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "host_watchdog_mode", NULL, 0, 260, 259, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){
                    {0, "as on the I-7000 series"},
                    {1, "analog and digital output commands clear the time-out status"},
                },
                2, 0x08000000u, I7000_ANY,
            },
            {
                "host_watchdog_enabled", NULL, 0, 261, 260, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "cjc_enabled", NULL, 0, 268, 267, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE, I7000_REGISTER_BOOL, 0,
                1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "modbus_data_format", NULL, 0, 269, 268, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "hex"}, {1, "engineering"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "host_watchdog_timed_out", NULL, 0, 270, 269, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "not timed out"}, {1, "timed out; writing 1 clears it"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "load_factory_calibration", NULL, 0, 272, 271, 1, I7000_AREA_COIL, I7000_WRITE, I7000_REGISTER_BOOL, 1,
                1,
                (const i7000_value[]){{1, "load the calibration of the factory"}},
                1, 0x08000000u, I7000_ANY,
            },
            {
                "reset_status", NULL, 0, 273, 272, 1, I7000_AREA_COIL, I7000_READ, I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "read before since power-on"}, {1, "first read since power-on"}},
                2, 0x08000000u, I7000_ANY,
            },
            {
                "open_wire_detection", NULL, 0, 276, 275, 1, I7000_AREA_COIL, I7000_READ | I7000_WRITE,
                I7000_REGISTER_BOOL, 0, 1,
                (const i7000_value[]){{0, "disabled"}, {1, "enabled"}},
                2, 0x08000000u, I7000_ANY,
            },
        },
        29,
    },
};
const char *const i7000_fault_names[18] = {
    "none",
    "length",
    "terminator",
    "character",
    "leading",
    "checksum",
    "command",
    "unsupported",
    "address",
    "number",
    "value",
    "crc",
    "function",
    "sub_function",
    "count",
    "echo",
    "reserved",
    "range",
};
const char *const i7000_field_names[35] = {
    "none",
    "address",
    "build",
    "channel",
    "coil",
    "count",
    "enabled",
    "exception_code",
    "first_reading",
    "function",
    "line_result",
    "line_settings",
    "major",
    "mask",
    "minor",
    "modbus_supported",
    "name",
    "new_address",
    "offset",
    "protocol",
    "protocol_result",
    "register",
    "report_settings",
    "result",
    "settings",
    "single_ended",
    "start",
    "status",
    "temperature",
    "timeout",
    "type_code",
    "update",
    "value",
    "values",
    "version",
};
const char *const i7000_dcon_names[64] = {
    "SetConfiguration",
    "SynchronizedSampling",
    "ReadAnalogInputs",
    "ReadAnalogInput",
    "CalibrateSpan",
    "CalibrateZero",
    "CalibrateCurrentChannelSpan",
    "CalibrateChannelZero",
    "CalibrateChannelSpan",
    "ReadConfiguration",
    "ReadCjcTemperature",
    "ReadSynchronizedData",
    "SetChannelMask",
    "ReadChannelMask",
    "SetChannelTypeCode",
    "ReadChannelTypeCode",
    "ReadCjcOffset",
    "SetCjcOffset",
    "ReadAnalogInputsHex",
    "ReadCjcUpdate",
    "SetCjcUpdate",
    "ReadDiagnostics",
    "ReadFirmwareVersion",
    "ReadModuleName",
    "ReadProtocol",
    "SetProtocol",
    "CalibrateInternally",
    "ReloadDefaultCalibration",
    "ReadCjcEnabled",
    "SetCjcEnabled",
    "SetCalibrationEnabled",
    "SoftInit",
    "SetModuleName",
    "SetSoftInitTimeout",
    "HostOk",
    "ReadHostWatchdogStatus",
    "ResetHostWatchdogStatus",
    "ReadHostWatchdogTimeout",
    "SetHostWatchdogTimeout",
    "ReadOpenWireDetection",
    "SetOpenWireDetection",
    "ReadConnectingMode",
    "SetConnectingMode",
    "Acknowledged",
    "AnalogInputs",
    "AnalogInput",
    "Configuration",
    "CjcTemperature",
    "SynchronizedData",
    "ChannelMask",
    "ChannelTypeCode",
    "CjcOffset",
    "AnalogInputsHex",
    "CjcUpdateSetting",
    "Diagnostics",
    "FirmwareVersion",
    "ModuleName",
    "ProtocolSetting",
    "CjcEnabled",
    "HostWatchdogStatus",
    "HostWatchdogTimeout",
    "OpenWireDetection",
    "ConnectingMode",
    "Refused",
};
const char *const i7000_modbus_names[51] = {
    "ReadCoils",
    "ReadDiscreteInputs",
    "ReadHoldingRegisters",
    "ReadInputRegisters",
    "WriteSingleCoil",
    "WriteSingleRegister",
    "WriteMultipleCoils",
    "WriteMultipleRegisters",
    "ReadModuleName",
    "SetModuleAddress",
    "ReadCommunicationSettings",
    "SetCommunicationSettings",
    "ReadTypeCode",
    "SetTypeCode",
    "ReadFirmwareVersion",
    "ReadChannelMask",
    "SetChannelMask",
    "ReadMiscellaneousSettings",
    "SetMiscellaneousSettings",
    "ReadCjcOffset",
    "SetCjcOffset",
    "ReadCjcEnabled",
    "SetCjcEnabled",
    "ReadCjcUpdate",
    "SetCjcUpdate",
    "Coils",
    "DiscreteInputs",
    "HoldingRegisters",
    "InputRegisters",
    "SingleCoilWritten",
    "SingleRegisterWritten",
    "MultipleCoilsWritten",
    "MultipleRegistersWritten",
    "ModuleName",
    "ModuleAddressResult",
    "CommunicationSettings",
    "CommunicationSettingsResult",
    "TypeCodeSetting",
    "TypeCodeResult",
    "FirmwareVersion",
    "ChannelMask",
    "ChannelMaskResult",
    "MiscellaneousSettings",
    "MiscellaneousSettingsResult",
    "CjcOffset",
    "CjcOffsetResult",
    "CjcEnabled",
    "CjcEnabledResult",
    "CjcUpdateSetting",
    "CjcUpdateResult",
    "ExceptionResponse",
};
const char *const i7000_status_names[4] = {
    "ok",
    "over_range",
    "under_range",
    "disabled",
};
const char *const i7000_unit_names[4] = {
    "mV",
    "V",
    "mA",
    "degC",
};

#endif /* I7000_DEFINE_TABLES */

#ifdef __cplusplus
}
#endif

#endif /* I7000_H */
