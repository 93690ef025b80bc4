# The service as one program in an otherwise empty root: ./dev image builds, runs and tries it.
#
#   docker build -t seedmesh .
#   docker run --read-only --cap-drop ALL --user 10001 -p 8080:8080 seedmesh
#
# Both stages of Debian 12 (--build-arg BASE=debian:bookworm-slim) and 13 work.
ARG BASE=debian:trixie-slim
FROM ${BASE} AS build
WORKDIR /seedmesh

# Packages first, so that a change of the code installs nothing anew. A network that signs traffic with a certificate of its own
# hands it in as the secret "certificates"; it stays out of the image.
COPY dev ./
RUN --mount=type=secret,id=certificates --mount=type=cache,target=/var/cache/apt \
  if [ -s /run/secrets/certificates ]; then export NODE_EXTRA_CA_CERTS=/run/secrets/certificates; fi; ./dev setup build
COPY web_client/package.json web_client/package-lock.json web_client/
RUN --mount=type=secret,id=certificates \
  if [ -s /run/secrets/certificates ]; then export NODE_EXTRA_CA_CERTS=/run/secrets/certificates; fi; ./dev setup build

# The page, then the program that carries it. No test is compiled here.
COPY web_client web_client
RUN cd web_client && PATH="/seedmesh/build/tools/node_modules/.bin:$PATH" npm run --silent build
COPY CMakeLists.txt CMakePresets.json LICENSE README.md ./
COPY api_schema api_schema
COPY core core
COPY docs docs
COPY server server
RUN --mount=type=cache,target=/root/.cache/ccache \
  cmake --preset release -DSEEDMESH_TESTS=OFF && cmake --build build/release --target seedmesh -- -k 0
COPY deploy/rootfs.sh deploy/rootfs.sh
RUN deploy/rootfs.sh build/release/seedmesh /rootfs

FROM scratch
ARG VERSION=unknown
ARG REVISION=unknown
LABEL org.opencontainers.image.title="Seedmesh" \
  org.opencontainers.image.description="Seeded 3D models from grammars, as glTF over HTTP" \
  org.opencontainers.image.licenses="MIT" \
  org.opencontainers.image.version="${VERSION}" \
  org.opencontainers.image.revision="${REVISION}" \
  org.opencontainers.image.documentation="/docs of the running service" \
  io.seedmesh.sbom="/licences/sbom.spdx.json"
COPY --from=build /rootfs /
# Variables, so that another port holds for the service and for the check of its health.
ENV SEEDMESH_HOST=0.0.0.0 SEEDMESH_PORT=8080
EXPOSE 8080
USER 10001:10001
STOPSIGNAL SIGTERM
HEALTHCHECK --interval=10s --timeout=5s --start-period=5s --retries=3 \
  CMD ["/usr/bin/seedmesh", "healthcheck", "--host", "127.0.0.1"]
ENTRYPOINT ["/usr/bin/seedmesh"]
CMD ["serve"]
