// What is known of a run: measures, histograms, stages, warnings.
import { el, figure, svg } from "./dom";
import type { Histogram, Measure, RunInfo, StageRow } from "./messages";

export class Report {
  readonly element = el("div", { class: "report" });
  onStage: ((stage: string) => void) | null = null;

  show(info: RunInfo | null): void {
    if (!info) {
      const hint = "Measures of the grid, with the floors that topology and curvature set, come here.";
      this.element.replaceChildren(el("p", { class: "hint" }, [hint]));
      return;
    }
    this.element.replaceChildren(
      ...headline(info),
      ...warnings(info),
      ...groups(info.measures),
      section("Spread", info.histograms.map(histogram)),
      ...(info.stages.length ? [section("Stages", [this.stages(info.stages)])] : []),
    );
  }

  private stages(rows: StageRow[]): HTMLElement {
    const head = ["Stage", "s", "irr.", "μ", "δ", "r %", "Q"].map((t) => el("th", { scope: "col" }, [t]));
    const body = rows.map((row) =>
      el(
        "tr",
        {
          tabindex: 0,
          title: [...row.notes, row.converged ? "" : "did not converge"].filter(Boolean).join("; "),
        },
        [
          el("th", { scope: "row" }, [row.name + (row.converged ? "" : " *")]),
          ...[
            row.seconds.toFixed(2),
            row.irregular?.toString() ?? "–",
            row.mu?.toFixed(3) ?? "–",
            row.delta_deg?.toFixed(1) ?? "–",
            row.cv === null ? "–" : (100 * row.cv).toFixed(1),
            row.fluency?.toFixed(2) ?? "–",
          ].map((t) => el("td", {}, [t])),
        ],
        {
          onclick: () => this.onStage?.(row.name),
          onkeydown: (e) => e.key === "Enter" && this.onStage?.(row.name),
        },
      ),
    );
    return el("table", { class: "stages" }, [el("thead", {}, [el("tr", {}, head)]), el("tbody", {}, body)]);
  }
}

function headline(info: RunInfo): HTMLElement[] {
  const { summary } = info;
  const big = (label: string, value: string) =>
    el("div", {}, [el("b", {}, [value]), el("span", {}, [label])]);
  return [
    el("div", { class: "headline" }, [
      big("nodes", summary.nodes.toLocaleString("en")),
      big("irregular", String(summary.irregular)),
      big("fluency Q", summary.fluency === null ? "∞" : summary.fluency.toFixed(1)),
    ]),
    el("p", { class: "detail" }, [summary.detail + (info.stopped ? ", stopped early" : "")]),
  ];
}

function warnings(info: RunInfo): HTMLElement[] {
  if (!info.warnings.length) return [];
  const items = info.warnings.map((w) => el("li", {}, [w]));
  return [
    el("details", { class: "warnings", open: items.length < 4 }, [
      el("summary", {}, [items.length === 1 ? "1 warning" : `${items.length} warnings`]),
      el("ul", {}, items),
    ]),
  ];
}

function groups(measures: Measure[]): HTMLElement[] {
  const names = [...new Set(measures.map((m) => m.group))];
  return names.map((name) => {
    const own = measures.filter((m) => m.group === name);
    const floors = own.some((m) => m.floor !== null);
    const rows = own.map((m) =>
      el("tr", { title: m.help, class: m.bad ? "bad" : "" }, [
        el("th", { scope: "row" }, [m.label]),
        el("td", {}, [m.value, m.unit && el("span", { class: "unit" }, [` ${m.unit}`])]),
        floors &&
          el("td", { class: "floor", title: "It cannot be less" }, [m.floor === null ? "" : `≥ ${m.floor}`]),
      ]),
    );
    return section(name, [el("table", { class: "measures" }, [el("tbody", {}, rows)])]);
  });
}

function section(title: string, content: (HTMLElement | Element)[], open = true): HTMLElement {
  return el("details", { class: "section", open }, [
    el("summary", {}, [title]),
    ...(content as HTMLElement[]),
  ]);
}

const WIDTH = 240;
const HEIGHT = 44;

function histogram(h: Histogram): HTMLElement {
  const most = Math.max(1, ...h.counts);
  const step = WIDTH / h.counts.length;
  const bars = h.counts.map((count, k) => {
    const height = (count / most) * HEIGHT;
    return svg("rect", { x: k * step + 0.5, y: HEIGHT - height, width: step - 1, height }, [
      Object.assign(svg("title", {}), {
        textContent: `${count} from ${figure(h.edges[k]!)} to ${figure(h.edges[k + 1]!)} ${h.unit}`,
      }),
    ]);
  });
  const ends = [h.edges[0]!, h.edges[h.edges.length - 1]!];
  return el("figure", { class: "histogram" }, [
    el("figcaption", {}, [h.title]),
    svg(
      "svg",
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", role: "img" },
      bars,
    ) as unknown as Node,
    el(
      "div",
      { class: "ends" },
      ends.map((x) => el("span", {}, [`${figure(x)} ${h.unit}`])),
    ),
  ]);
}
