// SPDX-License-Identifier: MIT
// Where ESP-IDF starts an application on a PC.
void app_main(void);

int main(void)
{
    app_main();
    return 0;
}
