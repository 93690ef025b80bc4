/** The events of a text/event-stream, as the service writes them: a name and one line of JSON. */
export interface ServerEvent { name: string; data: unknown }

export async function* events_of(body: ReadableStream<Uint8Array>): AsyncGenerator<ServerEvent> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let text = '';
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      text += decoder.decode(value, { stream: true });
      const blocks = text.split('\n\n');
      text = blocks.pop() ?? '';
      for (const block of blocks) {
        const lines = block.split('\n');
        const field = (name: string) => lines.find((line) => line.startsWith(`${name}: `))?.slice(name.length + 2);
        const name = field('event');
        if (name) yield { name, data: JSON.parse(field('data') ?? 'null') };
      }
    }
  } finally {
    await reader.cancel();
  }
}
