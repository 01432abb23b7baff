/* Prints the tables of i7000.h by the names of their fields, a row a line, for test_tables.py. */
#define I7000_DEFINE_TABLES
#include <inttypes.h>
#include <stdio.h>

#include "i7000.h"

static const uint32_t FIRMWARES[] = {
    I7000_FIRMWARE('A', 9, 9), I7000_FIRMWARE('B', 2, 6), I7000_FIRMWARE('B', 2, 10), I7000_FIRMWARE('B', 3, 5),
    I7000_FIRMWARE('B', 3, 9), I7000_FIRMWARE('B', 4, 1), I7000_FIRMWARE('B', 4, 5), I7000_NEWEST,
};

/* For each model one character a firmware. */
static void print_gates(const i7000_gate *gates, size_t count)
{
    for (unsigned model = 0; model < I7000_MODELS_SIZE; model++) {
        putchar(model == 0 ? '\t' : ' ');
        for (size_t at = 0; at < sizeof FIRMWARES / sizeof *FIRMWARES; at++)
            putchar(i7000_has(gates, count, model, FIRMWARES[at]) ? '1' : '0');
    }
}

static void print_parts(const i7000_part *parts, size_t count)
{
    putchar('\t');
    for (size_t at = 0; at < count; at++)
        printf("%s%s", parts[at].notation, at + 1 < count ? " " : "");
}

static void print_requests(const i7000_modbus_request *rows, size_t count)
{
    for (size_t at = 0; at < count; at++) {
        const i7000_modbus_request *it = &rows[at];
        printf("request\t%s\t%s\t%02X\t%02X\t%d\t%d\t%d\t%s\t%s\t%s", it->name, it->section, it->function,
               it->sub_function, it->is_broadcast, it->minimum_count, it->maximum_count,
               i7000_modbus_names[it->response_message], it->request, it->response);
        print_gates(it->gates, it->gate_count);
        putchar('\n');
    }
}

int main(void)
{
    for (size_t at = 0; at < I7000_TYPES_SIZE; at++) {
        const i7000_type *it = &i7000_types[at];
        printf("type\t%s\t%s\t%d\t%d\t%d\t%" PRId32 "\t%" PRId32 "\t%" PRId32 "\t%04X\t%04X\t%d\t%d\t%u\t%s\t%s\n",
               it->name, i7000_unit_names[it->unit], it->decimals, it->is_hex_signed, it->is_thermocouple, it->minimum,
               it->maximum, it->max, it->hex_minimum, it->hex_maximum, it->modbus_minimum, it->modbus_maximum,
               it->modbus_counts_per_unit, it->percent_minimum, it->percent_maximum);
    }
    for (size_t at = 0; at < I7000_MODELS_SIZE; at++) {
        const i7000_model *it = &i7000_models[at];
        printf("model\t%s\t%d\t%d\t%d\t%d\t%d\t%d\t%d\t%02X\t%d\t%d\t%d\t%d\t%08" PRIX32 "\t%08" PRIX32 "\t%06" PRIX32
               "\t%06" PRIX32 "\t%06" PRIX32 "\t%06" PRIX32 "\n",
               it->name, it->series, it->has_modbus, it->channels, it->single_ended_channels,
               it->is_single_ended_by_command, it->mask_digits, it->mask_digits_single_ended,
               it->default_type, it->uses_tt, it->has_cjc, it->has_open_wire_detection, it->has_fast_mode, it->types,
               it->later_types, it->later_types_from, it->individual_types_from, it->filter_from,
               it->character_formats_from);
    }
    for (size_t at = 0; at < I7000_DCON_COMMANDS_SIZE; at++) {
        const i7000_dcon_command *it = &i7000_dcon_commands[at];
        printf("command\t%s\t%s\t%s\t%s\t%s\t%u", it->name, it->section, it->syntax,
               it->response_syntax == NULL ? "" : it->response_syntax,
               it->response == I7000_NO_MESSAGE ? "" : i7000_dcon_names[it->response], it->pause_ms);
        print_parts(it->parts, it->part_count);
        print_parts(it->response_parts, it->response_part_count);
        print_gates(it->gates, it->gate_count);
        putchar('\n');
    }
    print_requests(i7000_modbus_functions, I7000_MODBUS_FUNCTIONS_SIZE);
    print_requests(i7000_module_settings, I7000_MODULE_SETTINGS_SIZE);
    for (size_t at = 0; at < I7000_MAPS_SIZE; at++) {
        const i7000_map *map = &i7000_maps[at];
        for (size_t place = 0; place < map->row_count; place++) {
            const i7000_register *it = &map->rows[place];
            printf("register\t%s\t%s\t%s\t%u\t%05u\t%u\t%u\t%u\t%u\t%u\t%" PRId32 "\t%" PRId32 "\t%lu\t%06" PRIX32,
                   map->section, it->name, it->unit == NULL ? "" : it->unit, it->counts_per_unit, it->number,
                   it->address, it->count, it->area, it->access, it->type, it->minimum, it->maximum,
                   (unsigned long)it->value_count, it->firmware);
            for (unsigned model = 0; model < I7000_MODELS_SIZE; model++)
                if (i7000_find_register(map, it->area, (unsigned)it->address + it->count - 1u, model, I7000_NEWEST) == it)
                    printf("\t%s", i7000_models[model].name);
            putchar('\n');
        }
    }
    for (size_t at = 0; at < I7000_SENTINELS_SIZE; at++) {
        const i7000_sentinel *it = &i7000_sentinels[at];
        printf("sentinel\t%s\t%d\t%d\t%08" PRIX32 "\t%s\t%04X\n", i7000_status_names[it->status], it->format, it->is_legacy,
               it->types, it->text == NULL ? "" : it->text, it->word);
    }
    return 0;
}
