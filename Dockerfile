# SPDX-License-Identifier: MIT
# Debian 12 with all that tools/demo and tools/test use, for other systems:
#
#   docker build -t fixpid .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/fixpid" fixpid tools/demo
#
# Without a command it runs tools/test. What is installed here is what the tools
# would ask for; `tools/test docs` compares the two.
FROM debian:12
RUN apt-get update && \
    DEBIAN_FRONTEND=noninteractive apt-get install -y \
        --no-install-recommends \
        arduino-builder arduino-core-avr avr-libc bison \
        chromium-headless-shell clang clang-format clang-tidy cmake coreutils \
        cppcheck dash debootstrap dpkg-dev flex g++ gcc gcc-arm-none-eabi \
        gcc-avr gcc-mingw-w64-x86-64 gcc-riscv64-unknown-elf gcovr git \
        gnuplot-nox gpsim-dev gputils libboost-dev libboost-graph-dev \
        libc6-dev libclang-rt-14-dev libsimavr-dev libxml2-utils lld make \
        meson mkdocs mkdocs-material mspdebug mypy ninja-build nodejs npm \
        patch picolibc-arm-none-eabi picolibc-riscv64-unknown-elf pkg-config \
        pmccabe python3-cffi python3-dev python3-kconfiglib \
        python3-matplotlib python3-numpy python3-scipy python3-setuptools \
        python3-venv python3-wheel qemu-system-arm qemu-system-misc ruby sdcc \
        sdcc-libraries sdcc-ucsim shellcheck simavr tcc util-linux wine \
        xz-utils zlib1g-dev \
    && rm -rf /var/lib/apt/lists/*
RUN gem install --no-document ceedling -v 1.2.1
COPY tools/lib/setup.sh /tmp/fixpid/
COPY tools/lib/build/build_sdcc /tmp/fixpid/build/
RUN /tmp/fixpid/build/build_sdcc /opt/fixpid/sdcc && \
    /tmp/fixpid/build/build_sdcc /opt/fixpid/spdk spdk && rm -r /tmp/fixpid
ENV SDCC=/opt/fixpid/sdcc/bin/sdcc SPDK=/opt/fixpid/spdk/bin/spdk
WORKDIR /fixpid
CMD ["tools/test"]
