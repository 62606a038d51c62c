/** Keep one broken part from taking the page down; Stop lives outside of it. */
import { Component, type ComponentChildren } from "preact";
import { t } from "../i18n";

export class Boundary extends Component<{ children: ComponentChildren }, { why: string | null }> {
  override state = { why: null };

  static override getDerivedStateFromError(error: unknown): { why: string } {
    return { why: String(error) };
  }

  override render() {
    const { why } = this.state;
    return why === null ? (
      this.props.children
    ) : (
      <p class="card bad" role="alert">
        {t("page.broken", { why })}
      </p>
    );
  }
}
