# One image for all processes; docker-compose.yml says which one a container runs.
# BASE may name a digest (debian@sha256:…) where builds must repeat to the byte.
ARG BASE=debian:trixie-slim

FROM ${BASE} AS build
SHELL ["/bin/bash", "-euo", "pipefail", "-c"]
RUN apt-get update \
    && apt-get install -y --no-install-recommends ca-certificates findutils gawk make python3 python3-venv \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /opt/pons
COPY . .
# The same as on any machine: every package from a lock, checked against its hash; then the page.
# EXTRAS=extras adds what the fleet needs.
ARG EXTRAS=
RUN CI=true make setup ${EXTRAS} \
    && rm -rf web/node_modules .venv/node-bin tests

FROM ${BASE} AS run
RUN apt-get update \
    && apt-get install -y --no-install-recommends python3 \
    && rm -rf /var/lib/apt/lists/* \
    && groupadd --gid 10001 pons \
    && useradd --uid 10001 --gid pons --home-dir /var/lib/pons --no-create-home pons \
    && install -d -o pons -g pons -m 2770 /var/lib/pons
COPY --from=build /opt/pons /opt/pons
WORKDIR /opt/pons
ENV PATH=/opt/pons/.venv/bin:$PATH PONS_HOME=/var/lib/pons PYTHONDONTWRITEBYTECODE=1
USER 10001:10001
VOLUME /var/lib/pons
CMD ["pons", "status"]
